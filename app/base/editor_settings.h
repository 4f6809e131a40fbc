#pragma once
// Settings that the editor keeps between sessions; not part of any project.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/error.h"

namespace weft {

/// Where a project was left.
struct ProjectPlace {
    std::optional<int> in, out;  ///< The marked range; unset ends are the shot's.
    std::optional<int> frame;    ///< Of the playhead; unset: the first one.
    bool operator==(const ProjectPlace&) const = default;
};

struct EditorSettings {
    bool dark = true;
    bool grey_surround = false;  ///< 18 % grey viewer background instead of near black.
    double ui_scale = 0;         ///< Interface scale; 0: the monitor's.
    std::map<std::string, std::string> keys;     ///< Command → "Ctrl+Shift+P"; only changed ones.
    std::map<std::string, double> sizes;         ///< Panel sizes by name, unscaled px.
    std::vector<std::string> recent;             ///< Project files, the newest first.
    std::map<std::string, ProjectPlace> places;  ///< Of recent projects, by file.
    std::vector<std::string> favourites;         ///< Favourite textures, by path.
    std::vector<std::string> recent_textures;
    std::map<std::string, std::vector<std::string>> collections;  ///< Name → textures, by path.
    std::vector<std::string> texture_folders;
    bool tour_seen = false;
    double matte_opacity = 0.38;  ///< Of the selected region's matte over the plate.
    /// Corrections of propagated frames count where they are made only (StrokeKind::kHere).
    bool here_only = true;
    std::string paint_program;  ///< Its command; empty: the first known one that is installed.
    double render_speed = 1;    ///< Speed of this machine, from calibrated_speed().
    std::string screen_display, screen_view;  ///< As ChooseScreen::name; both empty: the default.
    bool operator==(const EditorSettings&) const = default;
};

/// $XDG_CONFIG_HOME/weft/editor.json, or ~/.config/weft/editor.json.
[[nodiscard]] std::string editor_settings_path();
/// $XDG_STATE_HOME/weft, or ~/.local/state/weft: recovery files, job logs, unsaved mattes.
[[nodiscard]] std::string editor_state_folder();

/// Reads the settings; defaults if the file is missing or cannot be read.
[[nodiscard]] EditorSettings load_editor_settings(const std::string& path);
/// Writes the settings atomically. Errors: NoSpace, Unreadable.
[[nodiscard]] Status save_editor_settings(const std::string& path, const EditorSettings& settings);

}  // namespace weft

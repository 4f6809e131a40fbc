#pragma once
// The context passed to every panel: the session's view, a list for actions, and the theme.

#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "app/base/editor_settings.h"
#include "app/base/folder_lister.h"
#include "app/base/frames_on_disk.h"
#include "app/session/action.h"
#include "app/session/session_view.h"
#include "app/textures/texture_shelf.h"
#include "ui/base/commands.h"
#include "ui/base/picture_host.h"
#include "ui/base/state.h"
#include "ui/base/theme.h"

namespace weft {

/// The place of a widget by its label, for scripts and tests.
struct DrawnItem {
    std::string name;  ///< "Inspector/Scale"
    ImVec2 min, max;
    bool enabled = true;
};

struct Ctx {
    const SessionView& view;
    UiState& state;
    EditorSettings& settings;
    const Theme& theme;
    PictureHost& pictures;
    TextureShelf& textures;
    FolderLister& folders;
    FramesOnDisk& written;  ///< Of the output that the Jobs page proposes.
    Commands& commands;
    std::vector<Action>& actions;
    std::vector<DrawnItem>* items = nullptr;  ///< Null: widgets are not recorded.
    std::function<std::string(int)> job_log;
    std::function<void(int)> dismiss_notice;
    std::function<void(NoticeKind, std::string)> notify;  ///< Shows a message; null: it is lost.
    /// Performs actions at once and updates the view; null: like emit().
    std::function<void(const std::vector<Action>&)> act_now;
    std::string panel;  ///< Prefix of the items' names.

    void emit(Action action);
    /// For actions whose result must be visible in the current frame, such as a brush stroke.
    void emit_now(const std::vector<Action>& all);
    void edit(Edit what);
    /// Takes back what was tried.
    void drop_tried();
    /// Records the last ImGui item under a name.
    void note(std::string_view name, bool enabled = true);
    void note(std::string_view name, ImVec2 min, ImVec2 max, bool enabled = true);

  private:
    void mark_pointed(std::string_view name, ImVec2 min, ImVec2 max);
};

}  // namespace weft

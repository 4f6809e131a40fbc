#pragma once
// What every panel is given: the session as it stands, a place for the actions that it wants done,
// and the look.

#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "app/base/folder_lister.h"
#include "app/session/action.h"
#include "app/session/editor_settings.h"
#include "app/session/session_view.h"
#include "app/textures/texture_shelf.h"
#include "ui/commands.h"
#include "ui/picture_host.h"
#include "ui/state.h"
#include "ui/theme.h"

namespace weft {

/// Where a widget was drawn, by its label: what scripts and tests click on.
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
    Commands& commands;
    std::vector<Action>& actions;
    std::vector<DrawnItem>* items = nullptr;  ///< Null: widgets are not recorded.
    std::function<std::string(int)> job_log;
    std::function<void(int)> dismiss_notice;
    /// Does actions at once and brings the view up to date with them; null: like emit().
    std::function<void(const std::vector<Action>&)> act_now;
    std::string panel;  ///< Prefix of the items' names.

    void emit(Action action);
    /// For what this very frame is to show: a stroke under the brush.
    void emit_now(const std::vector<Action>& all);
    void edit(Edit what);
    /// Notes the last ImGui item under a name.
    void note(std::string_view name, bool enabled = true);
    void note(std::string_view name, ImVec2 min, ImVec2 max, bool enabled = true);
};

}  // namespace weft

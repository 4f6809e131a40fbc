#include "ui/base/state.h"

namespace weft {

void set_workspace(UiState& state, Workspace workspace) {
    if (state.workspace == workspace) return;
    if (state.workspace == Workspace::kMask) state.mask_tool = state.tool;
    state.workspace = workspace;
    // Never start with a brush outside the Mask workspace: an accidental stroke would change the
    // matte.
    state.tool = workspace == Workspace::kMask ? state.mask_tool : Tool::kPan;
    state.brush.outline.clear();
    state.shape_drawing = false;
    state.handle_held.clear();
}

void begin_document(UiState& state, std::uint64_t document) {
    const UiState fresh;
    state.document = document;
    const DisplaySettings display = state.viewer.display;
    const bool mattes_shown = state.viewer.mattes_shown;
    state.viewer = {};
    state.viewer.display = display;
    state.viewer.mattes_shown = mattes_shown;
    state.compare_with = {};
    state.brush.line_from.reset();
    state.brush.outline.clear();
    state.brush.painting = state.brush.lassoing = false;
    state.drawer = {};
    state.adding = {};
    state.output = {};
    state.transform = {};
    state.warp = {};
    state.handle_held.clear();
    state.pins.clear();
    const bool keys_open = state.keys.open;
    state.keys = {};
    state.keys.open = keys_open;
    state.lamp = 0;
    state.shape = {};
    state.shape_drawing = false;
    state.shape_box = {};
    state.scribbles = {};
    state.form = {};
    state.rectangle_from.reset();
    state.measured.reset();
    state.measured_count = fresh.measured_count;
    state.strip = fresh.strip;
    state.strip_textures.clear();
    state.strip_over_time = false;
    state.worst_by = 0;
    state.open_log = 0;
    state.renaming = 0;
    state.typing.clear();
    state.missing_dismissed = false;
}

const char* workspace_name(Workspace workspace) {
    switch (workspace) {
        case Workspace::kMask:
            return "Mask";
        case Workspace::kTexture:
            return "Texture";
        case Workspace::kMotion:
            return "Motion";
        case Workspace::kLight:
            return "Seams & Light";
        case Workspace::kReview:
            return "Review";
        case Workspace::kJobs:
            return "Jobs";
    }
    return "";
}

}  // namespace weft

#include "ui/commands.h"

#include <imgui.h>

#include <algorithm>

#include "ui/ctx.h"

namespace weft {

void set_workspace(UiState& state, Workspace workspace) {
    if (state.workspace == workspace) return;
    state.workspace = workspace;
    // Never start with a brush outside the Mask workspace: an accidental stroke would change the
    // matte.
    state.tool = workspace == Workspace::kMask ? Tool::kBrush : Tool::kPan;
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

Commands::Commands() : commands_(all_commands()) {
    bind({});
}

const Command* Commands::find(std::string_view id) const {
    const auto found = std::find_if(commands_.begin(), commands_.end(),
                                    [&](const Command& c) { return c.id == id; });
    return found == commands_.end() ? nullptr : &*found;
}

std::string Commands::key_of(std::string_view id) const {
    const Command* command = find(id);
    return command ? chord_text(command->key) : std::string();
}

void Commands::bind(const std::map<std::string, std::string>& changed) {
    for (Command& command : commands_) {
        command.key = parse_chord(command.default_key).value_or(KeyChord{});
        if (const auto own = changed.find(command.id); own != changed.end())
            if (const auto chord = parse_chord(own->second)) command.key = *chord;
    }
}

std::vector<std::string> Commands::collisions() const {
    std::vector<std::string> out;
    for (std::size_t a = 0; a < commands_.size(); ++a) {
        for (std::size_t b = a + 1; b < commands_.size(); ++b) {
            const Command &one = commands_[a], &other = commands_[b];
            if (one.key.key != 0 && one.key == other.key)
                out.push_back(one.name + " and " + other.name + ": " + chord_text(one.key));
        }
    }
    return out;
}

void Commands::run(std::string_view id, Ctx& ctx) const {
    const Command* command = find(id);
    if (command && (!command->enabled || command->enabled(ctx))) command->run(ctx);
}

void Commands::dispatch(Ctx& ctx) const {
    if (ImGui::GetIO().WantTextInput) return;
    const KeyChord first = pressed_chord(false), any = pressed_chord(true);
    for (const Command& command : commands_) {
        const KeyChord& pressed = command.repeats ? any : first;
        if (pressed.key == 0 || !(command.key == pressed)) continue;
        if (!command.enabled || command.enabled(ctx)) command.run(ctx);
        return;
    }
}

}  // namespace weft

#include "ui/base/commands.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "ui/base/ctx.h"

namespace weft {

Commands::Commands(std::vector<Command> commands) : commands_(std::move(commands)) {
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

#include "ui/input/keys.h"

#include <imgui.h>

#include <array>
#include <cctype>

namespace weft {
namespace {

struct NamedKey {
    const char* name;
    int key;
};
constexpr std::array kNamed{
    NamedKey{"Space", 32},     NamedKey{"Esc", 256},       NamedKey{"Enter", 257},
    NamedKey{"Tab", 258},      NamedKey{"Backspace", 259}, NamedKey{"Insert", 260},
    NamedKey{"Delete", 261},   NamedKey{"Right", 262},     NamedKey{"Left", 263},
    NamedKey{"Down", 264},     NamedKey{"Up", 265},        NamedKey{"PageUp", 266},
    NamedKey{"PageDown", 267}, NamedKey{"Home", 268},      NamedKey{"End", 269},
    NamedKey{"F1", 290},       NamedKey{"F2", 291},        NamedKey{"F3", 292},
    NamedKey{"F4", 293},       NamedKey{"F5", 294},        NamedKey{"F6", 295},
    NamedKey{"F7", 296},       NamedKey{"F8", 297},        NamedKey{"F9", 298},
    NamedKey{"F10", 299},      NamedKey{"F11", 300},       NamedKey{"F12", 301}};
// Keys that print this character on a US keyboard.
constexpr std::string_view kPrinting = "',-./0123456789;=ABCDEFGHIJKLMNOPQRSTUVWXYZ[\\]`";

}  // namespace

std::optional<KeyChord> parse_chord(std::string_view text) {
    KeyChord chord;
    while (!text.empty()) {
        const std::size_t plus = text.find('+', 1);
        const std::string part(text.substr(0, plus));
        text = plus == std::string_view::npos ? std::string_view() : text.substr(plus + 1);
        if (part == "Ctrl") {
            chord.ctrl = true;
        } else if (part == "Shift") {
            chord.shift = true;
        } else if (part == "Alt") {
            chord.alt = true;
        } else if (part.size() == 1 && kPrinting.find(static_cast<char>(
                                           std::toupper(static_cast<unsigned char>(part[0])))) !=
                                           std::string_view::npos) {
            chord.key = std::toupper(static_cast<unsigned char>(part[0]));
        } else {
            for (const NamedKey& named : kNamed)
                if (part == named.name) chord.key = named.key;
            if (chord.key == 0) return std::nullopt;
        }
    }
    return chord;
}

std::string chord_text(const KeyChord& chord) {
    if (chord.key == 0) return {};
    std::string text;
    if (chord.ctrl) text += "Ctrl+";
    if (chord.shift) text += "Shift+";
    if (chord.alt) text += "Alt+";
    for (const NamedKey& named : kNamed)
        if (chord.key == named.key) return text + named.name;
    return text + static_cast<char>(chord.key);
}

KeyChord pressed_chord(bool repeat) {
    const ImGuiIO& io = ImGui::GetIO();
    const auto chord = [&](int key) { return KeyChord{key, io.KeyCtrl, io.KeyShift, io.KeyAlt}; };
    for (const NamedKey& named : kNamed)
        if (ImGui::IsKeyPressed(named.key, repeat)) return chord(named.key);
    for (const char c : kPrinting)
        if (ImGui::IsKeyPressed(c, repeat)) return chord(c);
    return {};
}

bool chord_down(const KeyChord& chord) {
    return chord.key != 0 && ImGui::IsKeyDown(chord.key);
}

}  // namespace weft

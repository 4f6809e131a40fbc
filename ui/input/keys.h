#pragma once
// Key chords as text ("Ctrl+Shift+P") and as key codes.

#include <optional>
#include <string>
#include <string_view>

namespace weft {

/// ImGui 1.86 uses the key codes of its window backend: GLFW's, where letters and digits are ASCII
/// capitals.
struct KeyChord {
    int key = 0;
    bool ctrl = false, shift = false, alt = false;
    bool operator==(const KeyChord&) const = default;
};

/// Parses "Ctrl+Shift+P", "Left", "[", "F5", "Space". Returns nothing if a part is unknown; empty
/// text is the chord without a key.
[[nodiscard]] std::optional<KeyChord> parse_chord(std::string_view text);
[[nodiscard]] std::string chord_text(const KeyChord& chord);
/// The chord pressed in this frame, key repeats included; key 0: none.
[[nodiscard]] KeyChord pressed_chord(bool repeat);
[[nodiscard]] bool chord_down(const KeyChord& chord);

}  // namespace weft

#pragma once
// Key chords as text ("Ctrl+Shift+P") and as the window system numbers them.

#include <optional>
#include <string>
#include <string_view>

namespace weft {

/// ImGui 1.86 numbers keys as its window backend does: these are GLFW's numbers, letters and digits
/// being their ASCII capitals.
struct KeyChord {
    int key = 0;
    bool ctrl = false, shift = false, alt = false;
    bool operator==(const KeyChord&) const = default;
};

/// "Ctrl+Shift+P", "Left", "[", "F5", "Space". Nothing when a part is unknown; an empty text is the
/// chord without a key.
[[nodiscard]] std::optional<KeyChord> parse_chord(std::string_view text);
[[nodiscard]] std::string chord_text(const KeyChord& chord);
/// The chord that is being pressed in this frame, repeats included; key 0 when there is none.
[[nodiscard]] KeyChord pressed_chord(bool repeat);
[[nodiscard]] bool chord_down(const KeyChord& chord);

}  // namespace weft

#pragma once
// How the editor looks, as named tokens: no panel has a colour or a distance of its own.

#include <imgui.h>

#include <string>

namespace weft {

struct Theme {
    // Surfaces: neutral grey, so that the picture is the most colourful thing on the screen.
    ImU32 surround, panel, raised, field, line;
    ImU32 text, quiet, off;
    ImU32 accent, accent_hover, accent_press, on_accent;
    ImU32 good, warn, bad;
    ImU32 hover;  ///< Laid over whatever is under the mouse.
    ImU32 scrim;  ///< Behind what floats over the picture.
    // Distances in pixels, already scaled.
    float scale = 1;
    float gap, pad, group, row, radius, splitter, splitter_hit, thumb;
    float icon_button;
    // Fonts; the icons are merged into each.
    ImFont* regular = nullptr;
    ImFont* strong = nullptr;
    ImFont* small = nullptr;
    ImFont* title = nullptr;
    ImFont* display = nullptr;  ///< The name on the welcome screen, and large icons.

    [[nodiscard]] float px(float unscaled) const { return unscaled * scale; }
};

/// The tokens; fonts are not set.
[[nodiscard]] Theme make_theme(bool dark, bool grey_surround, float scale);
/// Puts the tokens into ImGui's own style.
void apply_theme(const Theme& theme);
/// Loads the fonts into the current context's atlas. Without the packages' fonts the built-in one
/// is used.
void load_fonts(Theme& theme);

/// Told apart by colour-blind eyes (Okabe and Ito 2008). Any index.
[[nodiscard]] ImU32 region_color(int index);
/// Its own colour, or one by its id where none was chosen.
[[nodiscard]] ImU32 region_color(int index, unsigned id);
/// A perceptually even map from dark to light, 0–1: seams, flicker, confidence.
[[nodiscard]] ImU32 heat_color(float value);
/// Heat of a frame's flicker beyond the plate's own and beyond what a texture moved unchanged
/// has, all in 8-bit steps (below 0: not known); below 0 where nothing is known.
[[nodiscard]] float flicker_heat(float flicker, float plate, float carried);
/// The same colour, its opacity multiplied.
[[nodiscard]] ImU32 faded(ImU32 color, float opacity);

}  // namespace weft

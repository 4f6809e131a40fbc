#pragma once
// The editor's theme as named tokens; panels define no colours or distances of their own.

#include <imgui.h>

#include <string>

namespace weft {

struct Theme {
    // Surfaces are neutral grey, so that they do not affect colour judgement.
    ImU32 surround, panel, raised, field, line;
    ImU32 text, quiet, off;
    ImU32 accent, accent_hover, accent_press, on_accent;
    ImU32 good, warn, bad;
    ImU32 hover;  ///< Overlay of the item under the mouse.
    ImU32 scrim;  ///< Background of floating items over the picture.
    // Distances, px, already scaled.
    float scale = 1;
    float gap, pad, group, row, radius, splitter, splitter_hit, thumb;
    float icon_button;
    // Fonts; the icons are merged into each.
    ImFont* regular = nullptr;
    ImFont* strong = nullptr;
    ImFont* small = nullptr;
    ImFont* title = nullptr;
    ImFont* display = nullptr;  ///< For the title of the welcome screen and large icons.

    [[nodiscard]] float px(float unscaled) const { return unscaled * scale; }
};

/// Returns the tokens, without fonts.
[[nodiscard]] Theme make_theme(bool dark, bool grey_surround, float scale);
/// Applies the tokens to ImGui's style.
void apply_theme(const Theme& theme);
/// Loads the fonts into the current context's atlas. If the font packages are missing, the built-in
/// font is used.
void load_fonts(Theme& theme);

/// Colours that colour-blind users can distinguish (Okabe and Ito 2008). Any index.
[[nodiscard]] ImU32 region_color(int index);
/// The region's colour, or one by its id if none is set.
[[nodiscard]] ImU32 region_color(int index, unsigned id);
/// A perceptually uniform colour map from dark to light, 0–1: seams, flicker, confidence.
[[nodiscard]] ImU32 heat_color(float value);
/// Heat of a frame's flicker above the plate's and above that of a texture moved unchanged, all in
/// 8-bit steps (below 0: not known); below 0 if the flicker is not known.
[[nodiscard]] float flicker_heat(float flicker, float plate, float floor);
/// The colour with its opacity multiplied.
[[nodiscard]] ImU32 faded(ImU32 color, float opacity);

}  // namespace weft

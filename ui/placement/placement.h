#pragma once
// Where the texture lies: the tools that transform and warp it, and the grid warp's section.

#include <array>
#include <optional>
#include <vector>

#include "ui/base/ctx.h"
#include "ui/canvas/view_map.h"

namespace weft::ui {

void transform_tool(Ctx& c, const ViewMap& map, bool hovered, bool active);
/// Moves the texture by the arrow keys while the transform tool is in hand. Returns true if one was
/// pressed.
bool nudge_texture(Ctx& c);
/// Corners around the selected region on this frame, for a corner pin; none without a matte.
[[nodiscard]] std::optional<std::array<Vec2, 4>> corners_around_region(Ctx& c);
/// x and y of each corner in turn, to a hundredth of a pixel: more digits only fill the field.
[[nodiscard]] std::vector<double> numbers_of(const std::array<Vec2, 4>& corners);

/// The reference line: its length in repeats sets the scale.
void measure_tool(Ctx& c, const ViewMap& map, bool hovered, bool active);

void warp_tool(Ctx& c, const ViewMap& map, bool hovered, bool active);
/// Moves the selected points of a grid warp by the arrow keys. Returns true if one was pressed.
bool nudge_warp(Ctx& c);
/// The grid warp of the region, or the one that would be laid over its corner pin or matte; none
/// without either.
[[nodiscard]] std::optional<GridWarp> warp_shown(Ctx& c, const Region& region);
/// The grid warp: its size, fall-off and keys.
void warp_section(Ctx& c, const Region& region);

}  // namespace weft::ui

#pragma once
// The arithmetic of the transform box: scale and rotation about a pivot.

#include <array>
#include <optional>
#include <vector>

#include "app/project/edit.h"
#include "engine/core/image.h"
#include "engine/core/pixel_aspect.h"
#include "engine/core/quad.h"
#include "ui/base/placement_numbers.h"

namespace weft::ui {

/// The numbers of a frame, those of the keys where it has them.
[[nodiscard]] PlacementNumbers placement_on(const Placement& placement, int frame);
/// The edits that change the placement of a frame: its keys where it has them.
[[nodiscard]] std::vector<Edit> edits_of_placement(const Region& region, int frame,
                                                   const PlacementNumbers& to);

// The numbers with the offset unsqueezed, as the arithmetic below takes it, and squeezed again.
[[nodiscard]] PlacementNumbers unsqueezed(PlacementNumbers numbers, PixelAspect aspect);
[[nodiscard]] PlacementNumbers squeezed(PlacementNumbers numbers, PixelAspect aspect);

// `pivot` is a place where the placement acts (SurfacePlaces::at), and stays where it is.
[[nodiscard]] PlacementNumbers scaled_about(PlacementNumbers from, Vec2 pivot, double factor);
[[nodiscard]] PlacementNumbers turned_about(PlacementNumbers from, Vec2 pivot, double degrees);

/// The smallest box around what a matte covers, with sides along axes that are turned
/// counter-clockwise on the picture unsqueezed: top left, top right, bottom right, bottom left, in
/// pixels of the plate. Empty for an empty matte.
[[nodiscard]] std::optional<Quad<float>> box_around(const ViewU8x1& matte, double degrees,
                                                    PixelAspect aspect = {});

}  // namespace weft::ui

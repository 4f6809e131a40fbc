#pragma once
// Bezier shapes through outlines, with one number of points on many frames.

#include <vector>

#include "engine/mask/outline_path.h"
#include "engine/mask/roto_shape.h"

namespace weft {

/// An outline and where a shape's points are on it, in the order in which it goes: each place
/// beyond the one before, the last less than a length beyond the first.
struct PlacedPoints {
    const OutlinePath* path = nullptr;
    std::vector<double> places;
};

/// Places for the points of a shape: where the outline bends (Douglas–Peucker), three or more.
[[nodiscard]] std::vector<double> bend_places(const OutlinePath& path, double tolerance_px);

/// The shape through these places: between two the handles fit the outline by least squares, along
/// its directions there; where these differ by more than 40° the point is a corner.
[[nodiscard]] RotoShape fitted_shape(const PlacedPoints& points);

/// Adds points, as many on all frames, halfway along an outline between two, until the shapes are
/// within about 0.3 px of all outlines (root mean square between two points, 0.9 px at most) or
/// their points 6 px apart; at most 2,000 points. `frames` all have as many. Returns a shape for
/// each. Pure and thread-safe.
[[nodiscard]] std::vector<RotoShape> fitted_shapes(std::vector<PlacedPoints> frames);

}  // namespace weft

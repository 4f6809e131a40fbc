#pragma once
// Lays one patch over the canvas: the overlap as a seam problem, its solution, and the update of
// the canvas.

#include <optional>

#include "engine/synthesis/canvas.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

/// A patch to lay: atlas pixel p − origin shows at canvas position p, for p in `rect`. `rect` lies
/// inside `block` and, except on a torus, inside the canvas.
struct Patch {
    Recti rect;
    Vec2i origin{0, 0};
};

/// The overlap of a patch with the filled part of the canvas. Overlap pixels with a filled
/// neighbour outside the patch are tied to the old side; others with an unfilled neighbour inside
/// it to the new side. Costs and guide are those of the options.
[[nodiscard]] SeamProblem overlap_problem(const Canvas& canvas, const Block& block, ViewU8x3 atlas,
                                          const Patch& patch, const PlaneOptions& options,
                                          float gradient_floor = kGradientFloor);

/// Finds the seam by the options' method and stores the patch's side of it in the canvas. Returns
/// the memory that the solver used, in bytes.
std::size_t lay_patch(Canvas& canvas, const Block& block, ViewU8x3 atlas, const Patch& patch,
                      const PlaneOptions& options, float gradient_floor = kGradientFloor);

}  // namespace weft

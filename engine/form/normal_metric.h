#pragma once
#include <array>
#include <optional>

#include "engine/form/metric_field.h"
#include "engine/form/view_camera.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// Brings a normal pass into view space, facing the camera. `normals`: H×W×3 of any length; zero or
/// not finite: unknown. `camera_from_world`: by rows, x to the right, y up, along whichever way z
/// is; the identity for normals that are in such axes already. Empty if more than a fifth of the
/// pixels inside of `matte` (255) face away from the camera with z either way: they are in other
/// axes. Thread-safe.
[[nodiscard]] std::optional<ImageF3> view_normals(ViewF3 normals, ViewU8x1 matte,
                                                  const ViewCamera& camera,
                                                  const std::array<double, 9>& camera_from_world);

/// Adds the form that normals in view space show, as view_normals() gives them, on a frame;
/// `matte`, `ref_from_cur` and `weight` as in add_positions(). With ray r and normal n, the slopes
/// of ln depth are −(n · ∂r) / (n · r) (Durou et al. 2020, eq. 14); they are integrated by weighted
/// least squares over blocks of half the field's spacing, for the perspective's share of the size.
/// Depth has no unit here: the first frame's is taken as it comes, later ones are scaled to what
/// the field holds at the same places, and count only if they meet it. Thread-safe.
void add_normals(MetricField& field, ViewF3 normals, ViewU8x1 matte, const ViewCamera& camera,
                 const LatticeField& ref_from_cur, double weight = 1);

}  // namespace weft

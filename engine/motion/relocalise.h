#pragma once
// Finds a surface again that was out of view.

#include <optional>

#include "engine/motion/lattice_field.h"
#include "engine/motion/photometric_register.h"

namespace weft {

/// anchor_from_cur of a surface whose position is unknown: distinctive points of both pictures
/// (SIFT, Lowe 2004) are matched both ways, and the homography that most of them agree on is taken
/// (RANSAC with a fixed seed). Right to a pixel or two, as a start for registration; `spacing_px`
/// is the field's. Empty if fewer than 12 points agree or the map turns the surface inside out.
/// Pure; deterministic.
[[nodiscard]] std::optional<LatticeField> find_again(const RegistrationPicture& anchor,
                                                     const RegistrationPicture& cur, Size frame,
                                                     int spacing_px);

}  // namespace weft

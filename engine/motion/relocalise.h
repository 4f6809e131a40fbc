#pragma once
// Finding a surface again that was out of view.

#include <optional>

#include "engine/motion/lattice_field.h"
#include "engine/motion/photometric_register.h"

namespace weft {

/// anchor_from_cur of a surface about whose place nothing is known: distinctive points of both
/// pictures (SIFT, Lowe 2004) matched both ways, and the homography that most of them agree on
/// (RANSAC with a fixed seed). Right to a pixel or two, for registration to go on from;
/// `spacing_px` is the field's. Nothing when fewer than 12 points agree or the map turns the
/// surface inside out. Pure; deterministic.
[[nodiscard]] std::optional<LatticeField> find_again(const RegistrationPicture& anchor,
                                                     const RegistrationPicture& cur, Size frame,
                                                     int spacing_px);

}  // namespace weft

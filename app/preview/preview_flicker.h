#pragma once
// How steady neighbouring frames of the preview are, from small pictures of them.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

struct Picture;
struct RenderedFrame;

/// Pixels of a picture (column, row) where a seam of the texture plane shows, by rows.
using SeamPoints = std::vector<std::array<std::uint16_t, 2>>;
/// Empty for a frame without layers.
[[nodiscard]] SeamPoints seam_points(const RenderedFrame& frame);

/// One region on two neighbouring frames: small pictures of one size, encoded RGB, 1.0 = white.
struct FramePair {
    struct Frame {
        ImageF3 result, plate;
        Matte matte;  ///< Holdouts taken out.
        std::shared_ptr<const SeamPoints> seams;
    };
    Frame before, now;
    /// How the texture was carried from one to the other, on `now`'s pixels; empty: not known.
    FlowField before_from_now;
    int seam_scale = 1;     ///< Pixels of the seams' picture in one of the small pictures.
    float plate_scale = 1;  ///< Plate pixels in one of the small pictures.
};

/// What of a pair could be measured; below 0: not.
struct Steadiness {
    float flicker = -1, flicker_plate = -1;  ///< TDE of `weft measure`, 8-bit steps.
    float flicker_floor = -1;  ///< What it would be if the texture were carried unchanged.
    float chatter = -1;        ///< Of the matte's edge, plate pixels (metrics/matte_chatter.h).
    /// See seam_motion_px(), plate pixels: along the way that the texture was carried where that is
    /// known, else along the estimated motion.
    float seam_motion = -1;
};

/// Along a motion that is estimated from the plates by another method than the one that rendered
/// (metrics/measuring_motion.h). Thread-safe.
[[nodiscard]] Steadiness measure_steadiness(const FramePair& pair);

/// How far the points of `before`, moved along, are from the nearest of `now`: the mean, in pixels
/// of the seams' picture. Seams that stick to the surface have up to half a pixel, which is how
/// exactly they are known. Below 0 where fewer than 16 points can be followed. `motion` lies on a
/// picture that is smaller by `scale`.
[[nodiscard]] float seam_motion_px(const SeamPoints& before, const SeamPoints& now,
                                   const FlowField& motion, int scale);

/// The field at the centre of every pixel, valid everywhere.
[[nodiscard]] FlowField dense_flow(const LatticeField& field);

/// The picture as the display encodes it, as means over blocks of `factor` × `factor`.
[[nodiscard]] ImageF3 encoded_small(const Picture& picture, int factor);

}  // namespace weft

#pragma once
// Temporal stability of the preview, measured on small pictures of neighbouring frames.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/metrics/pops.h"
#include "engine/motion/lattice_field.h"

namespace weft {

struct Picture;
struct RenderedFrame;

/// Pixels (column, row) of a picture where the texture plane has a visible seam, in row order.
using SeamPoints = std::vector<std::array<std::uint16_t, 2>>;
/// Returns the seam points of a frame; empty without layers.
[[nodiscard]] SeamPoints seam_points(const RenderedFrame& frame);

/// One region on two neighbouring frames: small pictures of equal size, display-encoded RGB, 1.0 =
/// white.
struct FramePair {
    struct Frame {
        ImageF3 result, plate;
        Matte matte;  ///< Matte without holdouts.
        std::shared_ptr<const SeamPoints> seams;
    };
    Frame before, now;
    /// The texture's track from `now` to `before`, on `now`'s pixels; empty: not known.
    FlowField before_from_now;
    int seam_scale = 1;     ///< Pixels of the seam picture per pixel of the small pictures.
    float plate_scale = 1;  ///< Plate pixels per pixel of the small pictures.
};

/// Measurements of a pair of frames; below 0: not measured.
struct Steadiness {
    float flicker = -1, flicker_plate = -1;  ///< TDE as in `weft measure`, 8-bit steps.
    /// Flicker of a texture that moves unchanged: the smallest value that this measurement can
    /// give.
    float flicker_floor = -1;
    float chatter = -1;  ///< Edge chatter of the matte, plate px
    /// Seam motion, plate px (seam_motion_px()), relative to the texture's track if known,
    /// otherwise to the estimated motion.
    float seam_motion = -1;
    std::optional<PopSteps> steps = {};
};

/// Uses motion estimated from the plates by another method than the renderer's
/// (metrics/measuring_motion.h). Thread-safe.
[[nodiscard]] Steadiness measure_steadiness(const FramePair& pair);

/// Mean distance of the points of `before`, moved by `motion`, from the nearest point of `now`, in
/// pixels of the seam picture. Seams that stick to the surface give up to half a pixel because of
/// rounding. Below 0 if fewer than 16 points can be followed. `motion` refers to a picture that is
/// smaller by `scale`.
[[nodiscard]] float seam_motion_px(const SeamPoints& before, const SeamPoints& now,
                                   const FlowField& motion, int scale);

/// Samples the field at every pixel centre; valid everywhere.
[[nodiscard]] FlowField dense_flow(const LatticeField& field);

/// Averages the display-encoded picture over blocks of `factor` × `factor`.
[[nodiscard]] ImageF3 encoded_small(const Picture& picture, int factor);

}  // namespace weft

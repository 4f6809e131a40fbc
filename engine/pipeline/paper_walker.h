#pragma once
// The paper's own temporal scheme (eq. 4–6), kept as the reference that the locked mode is compared
// with.

#include <optional>

#include "engine/core/error.h"
#include "engine/motion/lattice_field.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/sweep.h"

namespace weft {

/// The texels that a still placement shows on the whole frame: where a plane that is made anew for
/// a frame begins, and how large it is.
struct FramePlane {
    Vec2i origin;  ///< Texel of the placement's plane at the picture's (0, 0).
    Size size;
};
/// Errors: Usage when the placement would need more than 8192 texels along a side.
[[nodiscard]] Expected<FramePlane> frame_plane(const PlanePlacement& placement, Size plate);

/// Synthesises frame after frame: the previous result, warped along the surface's motion, enters
/// the cut's data term with λ_t; then T_t ← α T_t + (1 − α) warp(T_{t−1}).
class PaperWalker {
  public:
    PaperWalker(const RegionPlan& region, std::uint64_t seed, Size plate, const Backend* backend);
    /// The first frame, when there is no previous one.
    [[nodiscard]] Expected<ImageU8x3> start(int frame, const CancelToken& cancel);
    [[nodiscard]] Expected<ImageU8x3> advance(int frame, const LatticeField& prev_from_cur,
                                              const CancelToken& cancel);

  private:
    struct Warped {
        ImageU8x3 picture;
        Matte known;
    };
    [[nodiscard]] Expected<ImageU8x3> synthesise(int frame, const Warped* previous,
                                                 const CancelToken& cancel) const;
    [[nodiscard]] Warped warp(const LatticeField& prev_from_cur) const;

    const RegionPlan& region_;
    std::uint64_t seed_;
    const Backend* backend_;
    Expected<FramePlane> plane_;
    TextureMapping mapping_;
    ImageU8x3 last_;
};

}  // namespace weft

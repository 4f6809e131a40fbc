#pragma once
// Propagation of a painted matte from its keyframe to the neighbouring frames.

#include <memory>

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

struct MatteEstimate {
    Matte matte;
    float confidence = 1;  ///< 0–1: how certain the boundary is; 1 on the keyframe itself.
};

struct MatteOptions {
    float steadiness = 0.5f;  ///< 0–1: how much of the boundary's boil is taken out.
    /// Whether a painted edge is soft (MatteWalker::has_soft_edges()). If false, merging two
    /// estimates makes no edge soft, however uncertain it is.
    bool soft_edges = true;
};

/// Walks away from one keyframe, forwards or backwards in time, one frame at a time. The keyframe's
/// matte is never changed. Not thread-safe; two walkers may run in two threads.
class MatteWalker {
  public:
    /// `frame`: display-encoded 8-bit plate, H×W×3. `key`: its painted matte, the same size.
    /// `in_front`: the matte of what passes in front of it there; may be empty.
    MatteWalker(ViewU8x3 frame, ViewU8x1 key, const MatteOptions& options = {},
                ViewU8x1 in_front = {});
    ~MatteWalker();
    MatteWalker(MatteWalker&&) noexcept;
    MatteWalker& operator=(MatteWalker&&) noexcept;

    /// The matte of the next frame of the walk. `prev_from_cur`: for each pixel of `frame`, where
    /// it was in the walk's previous frame, pixels; `valid` marks reliable motion, and `d` is
    /// finite everywhere. `in_front`: of what passes in front; what it hides keeps its shape and
    /// goes on with what is seen of the surface, or with the background. All have the keyframe's
    /// size.
    [[nodiscard]] MatteEstimate advance(ViewU8x3 frame, const FlowField& prev_from_cur,
                                        ViewU8x1 in_front = {});

    /// Whether the keyframe's edge is soft anywhere: hair, fur, motion blur.
    [[nodiscard]] bool has_soft_edges() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Two estimates of one frame, from the keyframe before and the one after it. `position` in [0, 1]
/// is where the frame lies between them (0: at `from_before`'s keyframe). `in_front` as above.
[[nodiscard]] MatteEstimate merge_estimates(const MatteEstimate& from_before,
                                            const MatteEstimate& from_after, float position,
                                            ViewU8x3 frame, const MatteOptions& options = {},
                                            ViewU8x1 in_front = {});

}  // namespace weft

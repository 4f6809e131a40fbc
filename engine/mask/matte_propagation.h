#pragma once
// Propagation of a painted matte from its keyframe to the neighbouring frames.

#include <memory>
#include <vector>

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/mask/confirmed_part.h"

namespace weft {

struct MatteEstimate {
    Matte matte;
    float confidence = 1;  ///< 0–1: how certain the boundary is; 1 on the keyframe itself.
    /// Where and for how long a confirmed part of the walk's has been carried; empty: none has.
    FramesSince since = {};
    float since_confidence = 1;  ///< As `confidence`, but 1 where the last part was confirmed.
    /// What was followed all the way from the keyframe (Followed::known()), where walks are merged;
    /// else empty.
    Matte followed = {};
};

struct MatteOptions {
    float steadiness = 0.5f;  ///< 0–1: how much of the boundary's boil is taken out.
    /// Whether a painted edge is soft (MatteWalker::has_soft_edges()). If false, merging two
    /// estimates makes no edge soft, however uncertain it is.
    bool soft_edges = true;
    bool merged = false;  ///< Whether estimates of the walk are merged with those of another.
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
    /// A copy walks on by itself.
    MatteWalker(const MatteWalker& other);
    MatteWalker& operator=(const MatteWalker& other) { return *this = MatteWalker(other); }
    MatteWalker(MatteWalker&&) noexcept;
    MatteWalker& operator=(MatteWalker&&) noexcept;

    /// The matte of the next frame of the walk. `prev_from_cur`: for each pixel of `frame`, where
    /// it was in the walk's previous frame, pixels; `valid` marks reliable motion, and `d` is
    /// finite everywhere. `in_front`: of what passes in front; what it hides keeps its shape and
    /// goes on with what is seen of the surface, or with the background. All have the keyframe's
    /// size.
    [[nodiscard]] MatteEstimate advance(ViewU8x3 frame, const FlowField& prev_from_cur,
                                        ViewU8x1 in_front = {});

    /// Sets right what is confirmed on the walk's last frame, which has the part's size, and goes
    /// on from there. Returns that frame's matte. On the frame that the walk begins with, it says
    /// what of the painted matte is known.
    [[nodiscard]] MatteEstimate confirm(const ConfirmedPart& part);

    /// What the last step has found of the frames before its own, the latest first: 255 where they
    /// were inside as well, by blocks of a picture of their shape. Empty: nothing.
    [[nodiscard]] std::vector<Matte> take_late();

    /// Whether the keyframe's edge is soft anywhere: hair, fur, motion blur.
    [[nodiscard]] bool has_soft_edges() const;

  private:
    void begin_again(ViewU8x3 next, const FlowField& measured, bool hides);

    struct State;
    std::unique_ptr<State> state_;
};

/// The weight, 0–1 by pixel, of the estimate from the keyframe after: by the frame's place in time,
/// by confidence, and by what each walk has followed all the way; 0 or 1 where one alone knows.
[[nodiscard]] ImageF1 merge_shares(const MatteEstimate& from_before,
                                   const MatteEstimate& from_after, const MergePlace& place,
                                   Size size);

/// Two estimates of one frame, from the keyframe before and the one after it, between which it lies
/// at `place`. Where parts were confirmed on the way these count as well, and what only one walk
/// knows of stays as that walk has it. What one walk has followed from its keyframe counts for
/// more than what the other has seen appear. Where they disagree, `inside` (0–1 by pixel; may be
/// empty) says which is right (JointSides). `in_front` as above.
[[nodiscard]] MatteEstimate merge_estimates(const MatteEstimate& from_before,
                                            const MatteEstimate& from_after,
                                            const MergePlace& place, ViewU8x3 frame,
                                            const MatteOptions& options = {},
                                            ViewU8x1 in_front = {}, ViewF1 inside = {});

}  // namespace weft

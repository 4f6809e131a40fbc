#pragma once
// Where a walk's registrations jitter, what the steps between the frames say.

#include <deque>
#include <vector>

#include "engine/motion/lattice_field.h"

namespace weft {

/// A frame that was passed and its final position on the reference frame.
struct Settled {
    int frames_back = 0;  ///< From the walk's current frame.
    LatticeField ref_from_frame;
};

/// Registration against an anchor does not drift, and jitters with the noise of each frame; the
/// steps from frame to frame jitter less, and drift. So to each frame, the registrations of up to
/// kReach frames before and after are carried along the steps, and a line is fitted to them over
/// time, with weights that fall with the distance; its value at the frame is the position. A bias
/// of the steps, which is what drifts, is the slope and does no harm. (A fixed-lag smoother for a
/// random walk, Rauch, Tung & Striebel 1965, in its stationary form, with local linear regression
/// in place of the mean.) Deterministic. Not thread-safe.
class WalkSmoother {
  public:
    static constexpr int kReach = 3;  ///< Frames before and after.

    /// The walk's first frame, which stays where it is.
    void begin(const LatticeField& ref_from_cur);
    /// The next frame, registered at `ref_from_cur`; `prev_from_cur` is the step to it.
    void add(const LatticeField& ref_from_cur, const LatticeField& prev_from_cur);
    /// The next frame was not registered. Frames on either side say nothing of each other.
    void skip();
    /// The next frame shows the drawing of the present one, which therefore stays as it is.
    void hold();
    /// The current frame was placed there.
    void place(const LatticeField& ref_from_cur);
    /// No further frame follows.
    void finish() { settle(run_.size()); }

    /// Frames whose position is final now, each once; of others the position as walked is.
    [[nodiscard]] std::vector<Settled> take();

  private:
    struct Frame {
        int number = 0;
        LatticeField ref_from_frame, prev_from_frame, frame_from_prev;
        bool stays = false;
    };

    [[nodiscard]] LatticeField smoothed(std::size_t k) const;
    void settle(std::size_t before);

    std::deque<Frame> run_;     // frames in a row, at most kReach of them settled
    std::size_t settled_ = 0;   // of these
    std::vector<Settled> out_;  // by number
    int number_ = 0;            // of the current frame
};

}  // namespace weft

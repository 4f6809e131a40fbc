#pragma once
// Tracks a surface from its reference frame through the shot without drift.

#include <memory>
#include <vector>

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"
#include "engine/motion/optical_flow.h"
#include "engine/temporal/step_motion.h"
#include "engine/temporal/surface_kind.h"

namespace weft {

struct SurfaceWalkerOptions {
    FlowQuality quality = FlowQuality::kFinal;
    bool exact_motion = false;  ///< The motion is exact: follow it closely and do not register.
    int spacing_px = 8;         ///< Of the lattices.
    SurfaceKind kind = SurfaceKind::kFound;
};

/// A step of a walk as far as it does not depend on where the walk has led.
struct WalkStep {
    std::shared_ptr<const StepFrame> frame;  ///< The frame that it leads to.
    StepEvidence evidence;
};

/// Walks away from a reference frame, forwards or backwards in time, and keeps the position of
/// every pixel on it (method: "Temporal consistency", surface-locked mode).
///
/// Motion from frame to frame is fitted and chained: that of the picture inside, or where little
/// structure stands out of its noise and the outline bears it out better, the outline's
/// (gather_evidence()). A chain drifts, so each frame is also registered against an *anchor*, at
/// first the reference frame itself: by a homography where one explains the picture, else by a
/// smooth field (register_planar(), register_lattice()). What looks like a rigid plane is followed
/// as one until the clip refutes it (RigidPlane). Where either is blurred by motion, both
/// are compared blurred alike (ExposureMatch); what a step has lost is searched again (LostPlaces).
/// When too little of the anchor is visible, the current frame becomes the next anchor. A body
/// with joints is divided into parts, each with a walk of its own (JointedParts); the fields then
/// have a finer spacing. Not thread-safe; several walkers may run in several
/// threads.
class SurfaceWalker {
  public:
    /// `luma`: the frame to start from, 8 bit, H×W. `visible`: the full matte without holdouts.
    /// `extent`: the full matte; empty: `visible`. `ref_from_start`: where the start's pixels were
    /// on the reference frame; null: the start is the reference frame.
    SurfaceWalker(ViewU8x1 luma, ViewU8x1 visible, const SurfaceWalkerOptions& options,
                  const LatticeField* ref_from_start = nullptr, ViewU8x1 extent = {});
    /// The same, prepared.
    SurfaceWalker(std::shared_ptr<const StepFrame> start, const SurfaceWalkerOptions& options,
                  const LatticeField* ref_from_start = nullptr);
    ~SurfaceWalker();
    /// A copy walks on by itself; frames are shared.
    SurfaceWalker(const SurfaceWalker& other);
    SurfaceWalker& operator=(const SurfaceWalker& other) { return *this = SurfaceWalker(other); }
    SurfaceWalker(SurfaceWalker&&) noexcept;
    SurfaceWalker& operator=(SurfaceWalker&&) noexcept;

    /// Goes on to the next frame of the walk. `prev_from_cur`: raw motion, for each pixel its
    /// position in the walk's previous frame; `valid` marks reliable motion. Returns ref_from_cur,
    /// which is defined everywhere: behind holdouts and outside the matte the surface's motion is
    /// continued.
    const LatticeField& advance(ViewU8x1 luma, ViewU8x1 visible, const FlowField& prev_from_cur,
                                ViewU8x1 extent = {});
    /// The same, prepared: `step` leads from the frame to which the last advance() led, or from the
    /// first one. Not for exact motion.
    const LatticeField& advance(const WalkStep& step);
    /// Better positions on the reference frame for frames that were passed. A surface that returns
    /// into view shows too little of itself at first and is found some frames later. The latest
    /// first: the frame before the current one, the one before that, and so on. Empties the list.
    [[nodiscard]] std::vector<LatticeField> take_found_late();
    /// If `hide`, a texture that is stretched or sheared past the limit over much of the surface
    /// returns to its own shape at once (relaxed_stretch()), and a seam hides the change over the
    /// next frames. Otherwise it slides back slowly, which is the default.
    void hide_reanchoring(bool hide);
    /// For hiding_frames() after that: ref_from_cur without the return. Else null.
    [[nodiscard]] const LatticeField* stretched() const;
    /// Over how many frames the latest return is hidden: kReanchorFrames, or down to a quarter of
    /// that where the picture does not hold the surface.
    [[nodiscard]] int hiding_frames() const;
    /// Goes on to a frame whose motion is known everywhere: of the step, and to the frame of the
    /// anchor. Nothing is estimated or registered.
    void advance_known(ViewU8x1 luma, ViewU8x1 visible, LatticeField prev_from_cur,
                       LatticeField anchor_from_cur);
    /// From now on this is the walk of a part of the surface that it has followed so far: it is not
    /// divided by itself, and nothing of the whole's size is expected of it.
    void become_part();
    /// What the earlier frames against which it registers show beside `own` is no longer of this
    /// surface. `own`: its part of the last frame, H×W, 255 or 0.
    void keep_on_anchors(ViewU8x1 own);
    /// Whether it will likely ask what the outline says of the next step, which may be found ahead.
    [[nodiscard]] bool asks_outline() const;
    /// Whether the surface is taken for one rigid plane so far (RigidPlane): ref_from_cur() is a
    /// homography where it is seen.
    [[nodiscard]] bool is_plane() const;
    /// How many parts of the surface are followed by themselves (JointedParts); 0: it has none.
    [[nodiscard]] int part_count() const;
    /// Goes on to a frame that shows the same drawing as the frame before: nothing moves.
    void hold();
    /// Makes the current frame the anchor; for further reference frames. With `ref_from_here` the
    /// surface has that position from now on, whatever the walk has found.
    void anchor_here(const LatticeField* ref_from_here = nullptr);

    [[nodiscard]] const LatticeField& ref_from_cur() const;
    /// The surface's motion of the last step, defined everywhere.
    [[nodiscard]] const LatticeField& prev_from_cur() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace weft

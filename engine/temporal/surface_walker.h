#pragma once
// Following a surface from its reference frame through the shot, without drift.

#include <memory>
#include <vector>

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"
#include "engine/motion/optical_flow.h"

namespace weft {

struct SurfaceWalkerOptions {
    FlowQuality quality = FlowQuality::kFinal;
    bool exact_motion = false;  ///< The motion is true: follow it closely, do not register.
    int spacing_px = 8;         ///< Of the lattices.
};

/// Walks away from a reference frame, forwards or backwards in time, and holds where every pixel
/// was on it (method: "Temporal consistency", surface-locked mode).
///
/// Motion from frame to frame is fitted (fit_surface_motion) and chained; where the region shows
/// nothing but its outline (structure_to_noise), from that (register_outline). A chain drifts,
/// so each frame is also registered against an *anchor*, at first the reference frame itself: by a
/// homography where one explains the picture, else by a smooth field (register_planar,
/// register_lattice). When too little of the anchor is to be seen, the present frame becomes the
/// next one. Not thread-safe; several walkers may run in several threads.
class SurfaceWalker {
  public:
    /// `luma`: the frame to start from, 8 bit. `visible`: extent matte without holdouts, the same
    /// size. `extent`: the matte with what is hidden; empty: `visible`. `ref_from_start`: where the
    /// start's pixels were on the reference frame; the walk starts on the reference frame itself
    /// without it.
    SurfaceWalker(ViewU8x1 luma, ViewU8x1 visible, const SurfaceWalkerOptions& options,
                  const LatticeField* ref_from_start = nullptr, ViewU8x1 extent = {});
    ~SurfaceWalker();
    SurfaceWalker(SurfaceWalker&&) noexcept;
    SurfaceWalker& operator=(SurfaceWalker&&) noexcept;

    /// Goes on to the next frame of the walk. `prev_from_cur`: raw motion, for each of its pixels
    /// where it was in the frame before (of the walk); its `valid` says where that can be trusted.
    /// Returns ref_from_cur, which is defined everywhere: behind holdouts and outside the matte the
    /// surface's motion is continued.
    const LatticeField& advance(ViewU8x1 luma, ViewU8x1 visible, const FlowField& prev_from_cur,
                                ViewU8x1 extent = {});
    /// Where the pixels of frames that have been passed were on the reference frame, better than
    /// advance() could tell then: a surface that comes back into view shows too little of itself
    /// at first, and is found some frames later. The latest first: of the frame before the present
    /// one, the one before that, and so on. Empties it.
    [[nodiscard]] std::vector<LatticeField> take_found_late();
    /// Whether, from here on, a texture that has become stretched or sheared past the limit over
    /// much of the surface goes back to its own shape at once (relaxed_stretch()), which a seam is
    /// to hide over the next frames. Otherwise it slides back slowly. Off at first.
    void hide_reanchoring(bool hide);
    /// For kReanchorFrames frames after that: ref_from_cur as it would be without. Else null.
    [[nodiscard]] const LatticeField* stretched() const;
    /// Goes on to a frame whose motion is known as a whole: of the step, and to the frame at which
    /// the walk is anchored. Nothing is estimated and nothing registered.
    void advance_known(ViewU8x1 luma, ViewU8x1 visible, LatticeField prev_from_cur,
                       LatticeField anchor_from_cur);
    /// Goes on to a frame that shows the same drawing as the one before: nothing moves.
    void hold();
    /// Makes the present frame, whose pictures these are, the anchor: further reference frames.
    /// With `ref_from_here` the surface lies there from now on, whatever the walk has found.
    void anchor_here(ViewU8x1 luma, ViewU8x1 visible, const LatticeField* ref_from_here = nullptr);

    [[nodiscard]] const LatticeField& ref_from_cur() const;
    /// The surface's motion of the last step, defined everywhere.
    [[nodiscard]] const LatticeField& prev_from_cur() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace weft

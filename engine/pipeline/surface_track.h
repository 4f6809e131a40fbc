#pragma once
// Internal to follow_surfaces(): a surface's walk at the size at which it is followed, seen from
// the plate's.

#include <memory>
#include <vector>

#include "engine/pipeline/plate_views.h"
#include "engine/temporal/surface_walker.h"

namespace weft {

/// A frame for WalkStep where motion is estimated; mattes of the plate's size. `prev`: the one that
/// the step leads from; null: the walk begins here. Pure.
[[nodiscard]] std::shared_ptr<const StepFrame> step_frame(const PlateViews& views,
                                                          const Matte& visible, const Matte& extent,
                                                          const StepFrame* prev);

/// What raw motion, of the size of PlateViews::followed(), says of the step from `prev` to `cur`;
/// what the outline says is left open (picture_evidence()).
[[nodiscard]] StepEvidence step_evidence(std::shared_ptr<const StepFrame> prev,
                                         std::shared_ptr<const StepFrame> cur,
                                         std::shared_ptr<const FlowField> prev_from_cur,
                                         FlowQuality quality);

/// The step to a frame from exact motion, all of the plate's size. Pure.
[[nodiscard]] WalkStep exact_step(const PlateViews& views, const Matte& visible,
                                  const FlowField& prev_from_cur);

/// All mattes and lattices are of the plate's size; motion that was estimated from frame to frame
/// is of the size of PlateViews::followed(). A surface whose motion is known is not followed and
/// walks at the plate's size. Not thread-safe.
class SurfaceTrack {
  public:
    enum class Motion : std::uint8_t {
        kEstimated,
        kExact,  ///< From files: followed closely.
        kKnown   ///< By advance_known().
    };
    /// The spacing of the lattices of a walk, px of the plate.
    [[nodiscard]] static int spacing_for(Size plate, Motion motion);

    /// As SurfaceWalker's; `base` has the spacing that spacing_for() gives. `start`: the first
    /// frame as step_frame() made it, for estimated motion; else null.
    SurfaceTrack(const PlateViews& views, const Matte& visible, const Matte& extent, Motion motion,
                 SurfaceKind kind, FlowQuality quality, const LatticeField* base,
                 std::shared_ptr<const StepFrame> start);

    void advance(const WalkStep& step);
    void advance_known(const PlateViews& views, const Matte& visible, LatticeField prev_from_cur,
                       LatticeField anchor_from_cur);
    void hold();
    void anchor_here(const LatticeField* ref_from_here = nullptr);
    void hide_reanchoring(bool hide) { walker_.hide_reanchoring(hide); }

    [[nodiscard]] const LatticeField& ref_from_cur() const;
    [[nodiscard]] const LatticeField& prev_from_cur() const;
    /// As SurfaceWalker's.
    [[nodiscard]] bool asks_outline() const { return walker_.asks_outline(); }
    /// As SurfaceWalker's.
    [[nodiscard]] bool is_plane() const { return walker_.is_plane(); }
    /// As SurfaceWalker's; fields are finer where there are any.
    [[nodiscard]] int part_count() const { return walker_.part_count(); }
    /// Null unless a seam hides that the texture returned to its shape.
    [[nodiscard]] const LatticeField* stretched() const;
    /// As SurfaceWalker's.
    [[nodiscard]] int hiding_frames() const { return walker_.hiding_frames(); }
    [[nodiscard]] std::vector<LatticeField> take_found_late();

  private:
    [[nodiscard]] bool reduces() const { return followed_ != plate_; }
    [[nodiscard]] const Matte& luma_of(const PlateViews& views) const;
    [[nodiscard]] LatticeField in_plate(const LatticeField& field) const;
    void take_over();

    Size plate_, followed_;
    int spacing_px_;
    SurfaceWalker walker_;
    // At the plate's size, if that is another.
    LatticeField ref_from_cur_, prev_from_cur_, stretched_;
};

}  // namespace weft

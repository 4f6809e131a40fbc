#include "engine/pipeline/surface_track.h"

#include <algorithm>
#include <utility>

#include "engine/motion/follow_size.h"

namespace weft {
namespace {

// A matte or picture of the plate at the size of the walk.
class Followed {
  public:
    Followed(const Matte& of_plate, Size to) : of_plate_(of_plate) {
        if (!of_plate.empty() && of_plate.size() != to) small_ = reduced(of_plate, to);
    }
    operator ViewU8x1() const {  // NOLINT(google-explicit-constructor)
        return small_.empty() ? of_plate_.view() : small_.view();
    }

  private:
    const Matte& of_plate_;
    Matte small_;
};

SurfaceWalkerOptions walker_options(Size followed, SurfaceTrack::Motion motion,
                                    FlowQuality quality) {
    SurfaceWalkerOptions options;
    options.quality = quality;
    options.exact_motion = motion == SurfaceTrack::Motion::kExact;
    options.spacing_px = std::max(options.exact_motion ? 4 : 8, followed.width / 160);
    return options;
}

Size followed_size(Size plate, SurfaceTrack::Motion motion) {
    return motion == SurfaceTrack::Motion::kEstimated ? follow_size(plate) : plate;
}

SurfaceWalker walker_at(const PlateViews& views, const Matte& visible, const Matte& extent,
                        SurfaceWalkerOptions options, SurfaceKind kind, Size followed,
                        const LatticeField* base, std::shared_ptr<const StepFrame> start) {
    options.kind = kind;
    LatticeField small;
    if (base) small = resized(*base, followed, options.spacing_px);
    if (start) return {std::move(start), options, base ? &small : nullptr};
    const Matte& luma = views.luma.size() == followed ? views.luma : views.followed();
    return {luma, Followed(visible, followed), options, base ? &small : nullptr,
            Followed(extent, followed)};
}

}  // namespace

std::shared_ptr<const StepFrame> step_frame(const PlateViews& views, const Matte& visible,
                                            const Matte& extent, const StepFrame* prev) {
    const Size followed = views.followed().size();
    return std::make_shared<const StepFrame>(
        views.followed(), Followed(visible, followed), Followed(extent, followed),
        views.small_display ? views.small_display
                            : std::make_shared<const ImageU8x3>(views.display),
        prev);
}

StepEvidence step_evidence(std::shared_ptr<const StepFrame> prev,
                           std::shared_ptr<const StepFrame> cur,
                           std::shared_ptr<const FlowField> prev_from_cur, FlowQuality quality) {
    const SurfaceWalkerOptions options =
        walker_options(cur->size(), SurfaceTrack::Motion::kEstimated, quality);
    return picture_evidence(std::move(prev), std::move(cur), std::move(prev_from_cur), quality,
                            options.spacing_px);
}

WalkStep exact_step(const PlateViews& views, const Matte& visible, const FlowField& prev_from_cur) {
    const int spacing_px = SurfaceTrack::spacing_for(visible.size(), SurfaceTrack::Motion::kExact);
    auto frame = std::make_shared<const StepFrame>(views.luma, visible, visible);
    StepEvidence evidence = exact_evidence(*frame, prev_from_cur, spacing_px);
    return {std::move(frame), std::move(evidence)};
}

int SurfaceTrack::spacing_for(Size plate, Motion motion) {
    const Size followed = followed_size(plate, motion);
    const int spacing = walker_options(followed, motion, FlowQuality::kFinal).spacing_px;
    return (spacing * plate.width + followed.width / 2) / followed.width;
}

SurfaceTrack::SurfaceTrack(const PlateViews& views, const Matte& visible, const Matte& extent,
                           Motion motion, SurfaceKind kind, FlowQuality quality,
                           const LatticeField* base, std::shared_ptr<const StepFrame> start)
    : plate_(visible.size()),
      followed_(followed_size(plate_, motion)),
      spacing_px_(spacing_for(plate_, motion)),
      walker_(walker_at(views, visible, extent, walker_options(followed_, motion, quality), kind,
                        followed_, base, std::move(start))) {
    take_over();
}

const Matte& SurfaceTrack::luma_of(const PlateViews& views) const {
    return reduces() ? views.followed() : views.luma;
}

LatticeField SurfaceTrack::in_plate(const LatticeField& field) const {
    const int spacing = (field.spacing() * plate_.width + followed_.width / 2) / followed_.width;
    return resized(field, plate_, std::max(1, spacing));
}

void SurfaceTrack::take_over() {
    if (!reduces()) return;
    ref_from_cur_ = in_plate(walker_.ref_from_cur());
    prev_from_cur_ = in_plate(walker_.prev_from_cur());
    const LatticeField* stretched = walker_.stretched();
    stretched_ = stretched ? in_plate(*stretched) : LatticeField();
}

void SurfaceTrack::advance(const WalkStep& step) {
    walker_.advance(step);
    take_over();
}

void SurfaceTrack::advance_known(const PlateViews& views, const Matte& visible,
                                 LatticeField prev_from_cur, LatticeField anchor_from_cur) {
    walker_.advance_known(luma_of(views), visible, std::move(prev_from_cur),
                          std::move(anchor_from_cur));
}

void SurfaceTrack::hold() {
    walker_.hold();
    take_over();
}

void SurfaceTrack::anchor_here(const LatticeField* ref_from_here) {
    LatticeField small;
    if (ref_from_here) {
        small = resized(*ref_from_here, followed_, walker_.ref_from_cur().spacing());
        ref_from_here = &small;
    }
    walker_.anchor_here(ref_from_here);
    take_over();
}

const LatticeField& SurfaceTrack::ref_from_cur() const {
    return reduces() ? ref_from_cur_ : walker_.ref_from_cur();
}

const LatticeField& SurfaceTrack::prev_from_cur() const {
    return reduces() ? prev_from_cur_ : walker_.prev_from_cur();
}

const LatticeField* SurfaceTrack::stretched() const {
    if (!reduces()) return walker_.stretched();
    return stretched_.empty() ? nullptr : &stretched_;
}

std::vector<LatticeField> SurfaceTrack::take_found_late() {
    std::vector<LatticeField> found = walker_.take_found_late();
    if (reduces()) {
        for (LatticeField& field : found)
            field = in_plate(field);
    }
    return found;
}

}  // namespace weft

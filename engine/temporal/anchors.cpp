#include "engine/temporal/anchors.h"

namespace weft {

Registered register_against(const Anchor& anchor, const StepFrame& cur_frame, bool by_color,
                            const LatticeField& initial, FlowQuality quality) {
    const bool colors = by_color && anchor.frame->has_color() && cur_frame.has_color();
    const RegistrationPicture& there =
        colors ? anchor.frame->color_picture() : anchor.frame->picture();
    const RegistrationPicture& cur = colors ? cur_frame.color_picture() : cur_frame.picture();
    RegistrationOptions options;
    options.samples = quality == FlowQuality::kDraft ? 20000 : 60000;
    options.lattice_px = 3 * initial.spacing() / 2;
    options.iterations = 3;
    Registered out;
    out.anchor_from_cur = register_lattice(there, cur, initial, options);
    out.fit = registration_fit(there, cur, out.anchor_from_cur, options);
    options.iterations = 10;
    const PlanarRegistration plane = register_planar(there, cur, out.anchor_from_cur, options);
    // A homography has few parameters and the least jitter. It is used where it explains the frame
    // as well as the smooth field, which has enough parameters to follow some of the noise.
    constexpr double kAsWell = 1.03;
    out.planar = plane.found && plane.fit.residual <= kAsWell * out.fit.residual &&
                 kAsWell * plane.fit.share >= out.fit.share;
    if (out.planar) {
        out.anchor_from_cur = refine_planar(there, cur, plane.anchor_from_cur, options);
        out.fit = plane.fit;
    }
    return out;
}

void AnchorSet::add(Anchor anchor) {
    constexpr std::size_t kMost = 5;
    if (anchors_.size() == kMost) anchors_.erase(anchors_.begin() + 1);
    anchors_.push_back(std::move(anchor));
    present_ = anchors_.size() - 1;
}

}  // namespace weft

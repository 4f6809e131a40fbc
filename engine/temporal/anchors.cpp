#include "engine/temporal/anchors.h"

namespace weft {

RegisteredPictures pictures_of(const Anchor& anchor, const StepFrame& cur, bool by_color) {
    if (by_color && anchor.frame->has_color() && cur.has_color())
        return {anchor.frame->color_picture(), cur.color_picture(), cur.color()};
    return {anchor.frame->picture(), cur.picture(), cur.view().luma};
}

RegistrationOptions planar_options(FlowQuality quality) {
    RegistrationOptions options;
    options.samples = quality == FlowQuality::kDraft ? 20000 : 60000;
    options.iterations = 10;
    return options;
}

Registered register_against(const Anchor& anchor, const StepFrame& cur_frame, bool by_color,
                            const LatticeField& initial, FlowQuality quality) {
    const RegisteredPictures pictures = pictures_of(anchor, cur_frame, by_color);
    const RegistrationPicture &there = pictures.there, &cur = pictures.here;
    const RegistrationOptions planar = planar_options(quality);
    RegistrationOptions options = planar;
    options.lattice_px = 3 * initial.spacing() / 2;
    options.iterations = 3;
    Registered out;
    out.anchor_from_cur = register_lattice(there, cur, initial, options);
    out.fit = registration_fit(there, cur, out.anchor_from_cur, options);
    const PlanarRegistration plane = register_planar(there, cur, out.anchor_from_cur, planar);
    // A homography has few parameters and the least jitter. It is used where it explains the frame
    // as well as the smooth field, which has enough parameters to follow some of the noise.
    constexpr double kAsWell = 1.03;
    out.planar = plane.found && plane.fit.residual <= kAsWell * out.fit.residual &&
                 kAsWell * plane.fit.share >= out.fit.share;
    if (out.planar) {
        out.anchor_from_cur = refine_planar(there, cur, plane.anchor_from_cur, planar);
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

#include "engine/temporal/surface_walker.h"

#include <algorithm>
#include <cmath>

#include "engine/motion/contour_flow.h"
#include "engine/motion/photometric_register.h"
#include "engine/motion/surface_fit.h"
#include "engine/temporal/stretch_limit.h"

namespace weft {
namespace {

Matte copy_of(ViewU8x1 v) {
    Matte out(v.size());
    for (int y = 0; y < v.height(); ++y)
        std::copy(v.row(y), v.row(y) + v.width(), out.row(y));
    return out;
}

}  // namespace

struct SurfaceWalker::State {
    SurfaceWalkerOptions options;
    LatticeField ref_from_cur, prev_from_cur;
    Matte last_luma, last_visible;

    // The frame that the present one is registered against.
    RegistrationPicture anchor;
    LatticeField ref_from_anchor, anchor_from_cur;

    void become_anchor(ViewU8x1 luma, ViewU8x1 visible) {
        anchor = registration_picture(luma, visible);
        ref_from_anchor = ref_from_cur;
        anchor_from_cur = LatticeField(luma.size(), options.spacing_px);
    }

    // Whether the picture inside the region tells less about its motion than its outline does.
    [[nodiscard]] bool has_no_structure(ViewU8x1 luma, ViewU8x1 visible,
                                        const FlowField& motion) const {
        constexpr float kEnough = 1.25f;
        return structure_to_noise(luma, visible, last_luma, last_visible, motion) < kEnough;
    }

    [[nodiscard]] LatticeField fit_motion(ViewU8x1 luma, ViewU8x1 visible,
                                          const FlowField& motion) const {
        const int border = options.exact_motion ? 2 : 6;
        return fit_surface_motion(motion.d, motion_weights(luma, visible, motion.valid, border),
                                  fit_options());
    }

    [[nodiscard]] LatticeField fit_outline(ViewU8x1 luma, ViewU8x1 visible) const {
        const FlowField motion = estimate_contour_flow(luma, visible, last_luma, last_visible);
        SurfaceFitOptions fit = fit_options();
        fit.finest_px = 12;
        fit.correlation_px = 4;
        return fit_surface_motion(motion.d, motion.valid, fit);
    }

    [[nodiscard]] SurfaceFitOptions fit_options() const {
        SurfaceFitOptions fit;
        fit.spacing_px = options.spacing_px;
        if (options.exact_motion) {
            fit.finest_px = 8;
            fit.correlation_px = 1;
            fit.noise_floor_px = 0.005f;
        }
        return fit;
    }

    // The share of the region that the anchor still explains; corrects anchor_from_cur on the way.
    float register_against_anchor(ViewU8x1 luma, ViewU8x1 visible);
};

float SurfaceWalker::State::register_against_anchor(ViewU8x1 luma, ViewU8x1 visible) {
    const RegistrationPicture cur = registration_picture(luma, visible);
    RegistrationOptions fit;
    fit.samples = options.quality == FlowQuality::kDraft ? 20000 : 60000;
    fit.lattice_px = 3 * options.spacing_px / 2;
    fit.iterations = 3;
    const LatticeField smooth = register_lattice(anchor, cur, anchor_from_cur, fit);
    const RegistrationFit smooth_fit = registration_fit(anchor, cur, smooth, fit);
    fit.iterations = 10;
    const PlanarRegistration plane = register_planar(anchor, cur, smooth, fit);

    // A plane has few parameters and trembles least: it is taken where it explains the frame as
    // well as the smooth field does, which has enough of them to follow some of the noise.
    constexpr double kAsWell = 1.03;
    const bool planar = plane.found && plane.fit.residual <= kAsWell * smooth_fit.residual &&
                        kAsWell * plane.fit.share >= smooth_fit.share;
    // The chain is steady but drifts, the registration does not drift but trembles: the gains of
    // the (stationary) Kalman filters between them.
    constexpr float kPlanarGain = 0.85f, kSmoothGain = 0.7f;
    anchor_from_cur = planar ? mix(anchor_from_cur, plane.anchor_from_cur, kPlanarGain)
                             : mix(anchor_from_cur, smooth, kSmoothGain);
    return static_cast<float>(planar ? plane.fit.share : smooth_fit.share);
}

SurfaceWalker::SurfaceWalker(ViewU8x1 luma, ViewU8x1 visible, const SurfaceWalkerOptions& options,
                             const LatticeField* ref_from_start)
    : state_(std::make_unique<State>()) {
    const LatticeField still(luma.size(), options.spacing_px);
    state_->options = options;
    state_->ref_from_cur = ref_from_start ? *ref_from_start : still;
    state_->prev_from_cur = still;
    state_->last_luma = copy_of(luma);
    state_->last_visible = copy_of(visible);
    state_->become_anchor(luma, visible);
}

SurfaceWalker::~SurfaceWalker() = default;
SurfaceWalker::SurfaceWalker(SurfaceWalker&&) noexcept = default;
SurfaceWalker& SurfaceWalker::operator=(SurfaceWalker&&) noexcept = default;

const LatticeField& SurfaceWalker::advance(ViewU8x1 luma, ViewU8x1 visible,
                                           const FlowField& prev_from_cur) {
    State& s = *state_;
    const bool by_outline =
        !s.options.exact_motion && s.has_no_structure(luma, visible, prev_from_cur);
    s.prev_from_cur =
        by_outline ? s.fit_outline(luma, visible) : s.fit_motion(luma, visible, prev_from_cur);
    s.last_luma = copy_of(luma);
    s.last_visible = copy_of(visible);
    s.anchor_from_cur = compose(s.prev_from_cur, s.anchor_from_cur);
    if (s.options.exact_motion) {
        s.ref_from_cur = compose(s.anchor_from_cur, s.ref_from_anchor);
        return s.ref_from_cur;
    }
    if (by_outline) {
        // Nothing inside to be registered by: the chain goes on alone.
        s.ref_from_cur = compose(s.anchor_from_cur, s.ref_from_anchor);
        return s.ref_from_cur;
    }
    const float explained = s.register_against_anchor(luma, visible);
    s.ref_from_cur = compose(s.anchor_from_cur, s.ref_from_anchor);
    constexpr float kEnough = 0.6f;
    const bool slid = limit_stretch(s.ref_from_cur, visible);
    if (slid || explained < kEnough) s.become_anchor(luma, visible);
    return s.ref_from_cur;
}

void SurfaceWalker::anchor_here(ViewU8x1 luma, ViewU8x1 visible) {
    state_->become_anchor(luma, visible);
}

const LatticeField& SurfaceWalker::ref_from_cur() const {
    return state_->ref_from_cur;
}
const LatticeField& SurfaceWalker::prev_from_cur() const {
    return state_->prev_from_cur;
}

}  // namespace weft

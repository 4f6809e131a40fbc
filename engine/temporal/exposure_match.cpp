#include "engine/temporal/exposure_match.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "engine/motion/motion_blur.h"

namespace weft {
namespace {

// In correlation. Less may be chance.
constexpr double kClearGain = 0.02;

// The motion of both frames of a comparison, each as the other one shows it.
struct Motions {
    LatticeField of_cur_there, of_anchor_here;
    float apart_px = 0;  // the mean difference of the two, on the surface
};

std::optional<Motions> motions_of(const Anchor& anchor, const StepFrame& cur,
                                  const LatticeField& motion, const LatticeField& anchor_from_cur) {
    if (anchor.motion.empty() || motion.empty()) return std::nullopt;
    const LatticeField cur_from_anchor = inverse(anchor_from_cur);
    Motions out;
    out.of_cur_there = motion_seen_from(motion, cur_from_anchor, anchor_from_cur);
    out.of_anchor_here = motion_seen_from(anchor.motion, anchor_from_cur, cur_from_anchor);
    constexpr int kStride = 8;
    const ViewU8x1 visible = cur.view().visible;
    double sum = 0, n = 0;
    for (int y = 0; y < visible.height(); y += kStride) {
        for (int x = 0; x < visible.width(); x += kStride) {
            if (visible.at(x, y) < 128) continue;
            const Vec2 p(static_cast<float>(x), static_cast<float>(y));
            sum += static_cast<double>(glm::length(motion.at(p) - out.of_anchor_here.at(p)));
            ++n;
        }
    }
    out.apart_px = n > 0 ? static_cast<float>(sum / n) : 0;
    return out;
}

// A shutter that is open for all of it blurs by less than can be told.
bool moves_alike(const Motions& motions) {
    constexpr float kLittle_px = 3;
    return !(motions.apart_px > kLittle_px);
}

std::shared_ptr<const StepFrame> exposed(const StepFrame& frame, const LatticeField& motion,
                                         float share) {
    const OutlineView view = frame.view();
    const LatticeField still(motion.full_size(), motion.spacing());
    const ExposedFrame made = exposed_along(view.luma, view.visible, mix(still, motion, share));
    return std::make_shared<const StepFrame>(made.luma, made.visible, view.extent);
}

double agreement(const StepFrame& there, const StepFrame& here, const LatticeField& map) {
    return registration_agreement(there.picture(), here.picture(), map);
}

}  // namespace

void ExposureMatch::learn(const Anchor& anchor, const StepFrame& cur, const LatticeField& motion,
                          const LatticeField& anchor_from_cur) {
    constexpr int kEnough = 6;
    if (learnt_ == kEnough) return;
    const auto motions = motions_of(anchor, cur, motion, anchor_from_cur);
    if (!motions || moves_alike(*motions)) return;
    for (std::size_t k = 0; k < kShares.size(); ++k) {
        const float share = kShares[k];
        const double alike =
            agreement(*exposed(*anchor.frame, motions->of_cur_there, share),
                      *exposed(cur, motions->of_anchor_here, share), anchor_from_cur);
        const double twice = agreement(*exposed(*anchor.frame, anchor.motion, share),
                                       *exposed(cur, motion, share), anchor_from_cur);
        alike_[k] += alike;
        gains_[k] += alike - twice;
    }
    ++learnt_;
}

std::optional<Registered> ExposureMatch::registered(const Anchor& anchor, const StepFrame& cur,
                                                    const LatticeField& motion,
                                                    const LatticeField& initial,
                                                    const Registered& sharp,
                                                    FlowQuality quality) const {
    const float share = open_share();
    if (!(share > 0)) return std::nullopt;
    const auto motions = motions_of(anchor, cur, motion, initial);
    if (!motions || moves_alike(*motions)) return std::nullopt;
    const Anchor there{exposed(*anchor.frame, motions->of_cur_there, share), anchor.ref_from_anchor,
                       anchor.generation};
    const auto here = exposed(cur, motions->of_anchor_here, share);
    Registered alike = register_against(there, *here, false, initial, quality);
    if (agreement(*there.frame, *here, alike.anchor_from_cur) <
        agreement(*anchor.frame, cur, sharp.anchor_from_cur) + kClearGain)
        return std::nullopt;
    return alike;
}

float ExposureMatch::open_share() const {
    if (learnt_ == 0) return 0;
    const auto best = std::max_element(alike_.begin(), alike_.end()) - alike_.begin();
    const auto k = static_cast<std::size_t>(best);
    return gains_[k] > kClearGain * learnt_ ? kShares[k] : 0;
}

}  // namespace weft

#include "engine/motion/outline_register.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "engine/motion/bending_system.h"
#include "engine/motion/photometric_register.h"

namespace weft {
namespace {

struct Stage {
    float band_px, sigma_px;
    int lattice_px;
    float stiffness_px;
    int iterations;
};

class OutlineMatch {
  public:
    OutlineMatch(const OutlineShape& prev, const OutlineShape& cur)
        : prev_(prev), cur_(cur), scale_(static_cast<float>(cur.frame_size().width) / 640.0f) {}

    // True if a homography was found; `field` is its start and its result.
    bool planar(LatticeField& field) const {
        for (const Stage& stage : {Stage{24, 4, 0, 0, 15}, Stage{10, 2, 0, 0, 12}}) {
            const PlanarRegistration found =
                register_planar(of(prev_, stage), of(cur_, stage), field, options(stage));
            if (!found.found) return false;
            field = found.anchor_from_cur;
        }
        return true;
    }
    void smooth(LatticeField& field) const {
        // Stiff, because what the outline does not determine is best taken from the surroundings.
        // (assets/drawn, mean error of a step: cape 1.5 px; at four times the stiffness 3.0, at a
        // third 2.2.)
        for (const Stage& stage : {Stage{20, 4, 32, 0.25f, 14}, Stage{12, 2.5f, 24, 0.17f, 10},
                                   Stage{8, 1.2f, 16, 0.08f, 8}}) {
            field = register_lattice(of(prev_, stage), of(cur_, stage), field, options(stage));
        }
    }
    [[nodiscard]] double residual(const LatticeField& field, float band_px) const {
        const Stage stage{band_px, 2, 16, 0.1f, 1};
        const RegistrationFit fit =
            registration_fit(of(prev_, stage), of(cur_, stage), field, options(stage));
        return fit.residual + (1.0 - fit.share);
    }

    // The residual of a few samples in the widest band.
    [[nodiscard]] double roughly(const LatticeField& field) const {
        const Stage stage{24, 4, 16, 0.1f, 1};
        RegistrationOptions few = options(stage);
        few.samples = 4000;
        const RegistrationFit fit = registration_fit(of(prev_, stage), of(cur_, stage), field, few);
        return fit.residual + (1.0 - fit.share);
    }

  private:
    [[nodiscard]] static const RegistrationPicture& of(const OutlineShape& shape,
                                                       const Stage& stage) {
        return shape.picture(stage.band_px, stage.sigma_px);
    }
    [[nodiscard]] RegistrationOptions options(const Stage& stage) const {
        RegistrationOptions out;
        out.samples = 40000;
        out.iterations = stage.iterations;
        out.lattice_px = std::max(
            4, static_cast<int>(std::lround(scale_ * static_cast<float>(stage.lattice_px))));
        out.stiffness_px = stage.stiffness_px;
        // The picture of an outline is smooth, and no place of it is found to a tenth of a pixel.
        out.thinned = 2;
        out.still_px = 0.05f;
        return out;
    }

    const OutlineShape &prev_, &cur_;
    float scale_;  // of the lattices
};

LatticeField sum_of(const LatticeField& a, const LatticeField& b) {
    LatticeField out = a;
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i)
            out.set_node(i, j, a.node(i, j) + b.node(i, j));
    }
    return out;
}

// The similarity that turns the one extent by `angle` about its middle and lays it on the other.
LatticeField turned(const OutlineShape& prev, const OutlineShape& cur, long double angle,
                    int spacing_px) {
    LatticeField out(cur.frame_size(), spacing_px);
    const float size = std::sqrt(prev.area_px() / cur.area_px());
    // Long double: see docs/decisions/0002-determinism.md.
    const Vec2 across =
        size * Vec2(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)));
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i) {
            const Vec2 p = out.node_position(i, j), r = p - cur.middle();
            const Vec2 there(across.x * r.x - across.y * r.y, across.y * r.x + across.x * r.y);
            out.set_node(i, j, prev.middle() + there - p);
        }
    }
    return out;
}

constexpr float kNarrow = 8;

// The homography that explains the outline best, from no motion and, where a drawing moved too far
// for that, from the extent that is moved and turned as a whole.
std::optional<LatticeField> best_plane(const OutlineMatch& match, const OutlineShape& prev,
                                       const OutlineShape& cur, int spacing_px) {
    // Turning is taken where it explains clearly more: a disc's outline is the same at every angle.
    constexpr double kClearlyMore = 1.35;
    // An outline that is registered leaves less; there is nothing to look for.
    constexpr double kRegistered = 0.08;
    constexpr long double kStep = std::numbers::pi_v<long double> / 18;  // 10°
    constexpr int kMost = 9;
    std::optional<LatticeField> best;
    double least = 0;
    const auto consider = [&](LatticeField field, double handicap) {
        if (!match.planar(field)) return;
        const double left = match.residual(field, kNarrow);
        if (best && handicap * left >= least) return;
        least = left;
        best = std::move(field);
    };
    consider(LatticeField(cur.frame_size(), spacing_px), 1);
    if (best && least <= kRegistered) return best;
    LatticeField start;
    double nearest = 0;
    for (int k = -kMost; k <= kMost; ++k) {
        LatticeField field = turned(prev, cur, kStep * k, spacing_px);
        const double left = match.roughly(field);
        if (!start.empty() && left >= nearest) continue;
        nearest = left;
        start = std::move(field);
    }
    consider(std::move(start), best ? kClearlyMore : 1);
    return best;
}

// The motion of the places of the outline that was laid along the other one, and the thin plate
// that goes through it inside.
std::optional<LatticeField> by_curve(const OutlineShape& prev, const OutlineShape& cur,
                                     const LatticeField& plane) {
    constexpr double kPlace_px = 1.5;  // how far the pairs' places are off
    constexpr double kBend_px = 2;     // the usual second difference: hardly any resistance
    constexpr int kIterations = 300;
    const std::vector<OutlinePair> pairs = match_outlines(prev.curve(), cur.curve(), plane);
    if (pairs.empty()) return std::nullopt;
    LatticeField bent(cur.frame_size(), 3 * plane.spacing());
    BendingSystem system(bent);
    const double w = 1 / (kPlace_px * kPlace_px);
    for (const OutlinePair& pair : pairs) {
        const Vec2 more = pair.prev - pair.cur - plane.at(pair.cur);
        system.measure(pair.cur, {w, 0, w}, w * glm::dvec2(more));
    }
    const auto& x = system.solve(std::vector<glm::dvec2>(system.count()), 1 / (kBend_px * kBend_px),
                                 kIterations);
    for (int j = 0; j < bent.nodes().height(); ++j) {
        for (int i = 0; i < bent.nodes().width(); ++i) {
            bent.set_node(
                i, j,
                Vec2(
                    x[static_cast<std::size_t>(j) * static_cast<std::size_t>(bent.nodes().width()) +
                      static_cast<std::size_t>(i)]));
        }
    }
    return sum_of(plane, bent.resampled(plane.spacing()));
}

// From a homography, or from what became of corners; else from `field`, which fits the outline with
// a residual of `with_field`.
LatticeField best_of(const OutlineMatch& match, const OutlineShape& prev, const OutlineShape& cur,
                     LatticeField field, double with_field) {
    const std::optional<LatticeField> found = best_plane(match, prev, cur, field.spacing());
    // A raw estimate may fit the outline while the surface slips along it. A result that starts
    // from a homography, or from what became of corners, slips less and is preferred unless it
    // fits clearly worse.
    constexpr double kClearlyWorse = 1.35;
    const auto prefer = [&](LatticeField bent) {
        const double with_bent = match.residual(bent, kNarrow);
        if (with_bent > kClearlyWorse * with_field) return;
        field = std::move(bent);
        with_field = with_bent;
    };
    if (found) {
        LatticeField bent = *found;
        match.smooth(bent);
        prefer(std::move(bent));
    }
    // Where legs pass each other, no way around one outline is one around the other:
    // blender_fox_gt's fox keeps 0.8 and more of its slip, flags 0.3 to 0.6.
    constexpr double kSlipsToo = 0.065, kClearlyLess = 0.8, kHalf = 0.5;
    const double slip = outline_slip(prev.curve(), cur.curve(), field);
    if (slip > kSlipping) {
        const LatticeField whole = found ? *found : LatticeField(cur.frame_size(), field.spacing());
        const auto slips_less = [&](const LatticeField& curve) {
            const double left = outline_slip(prev.curve(), cur.curve(), curve);
            return left < kHalf * slip || (left < kSlipsToo && left < kClearlyLess * slip);
        };
        std::optional<LatticeField> curve = by_curve(prev, cur, whole);
        if (curve && slips_less(*curve)) {
            match.smooth(*curve);
            if (slips_less(*curve)) prefer(std::move(*curve));
        }
    }
    constexpr double kAsWell = 1.03, kAlmostNothing = 0.03;
    const bool plain =
        found && match.residual(*found, kNarrow) <= kAsWell * with_field + kAlmostNothing;
    return plain ? *found : field;
}

}  // namespace

LatticeField register_outline(const OutlineShape& prev, const OutlineShape& cur,
                              const LatticeField& initial) {
    if (prev.empty() || cur.empty()) return initial;
    const OutlineMatch match(prev, cur);
    LatticeField field = initial;
    match.smooth(field);
    const double with_field = match.residual(field, kNarrow);
    return best_of(match, prev, cur, std::move(field), with_field);
}

LatticeField register_outline(const OutlineShape& prev, const OutlineShape& cur, int spacing_px) {
    LatticeField still(cur.frame_size(), spacing_px);
    if (prev.empty() || cur.empty()) return still;
    const OutlineMatch match(prev, cur);
    return best_of(match, prev, cur, still, match.residual(still, kNarrow));
}

}  // namespace weft

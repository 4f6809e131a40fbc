#include "engine/motion/lattice_root.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

namespace weft {
namespace {

constexpr int kNewtonSteps = 8;
constexpr float kRootSettledPx = 1e-3f;

}  // namespace

LatticeRoot root_of(const LatticeField& field, Vec2 target, Vec2 start) {
    const auto residual = [&](Vec2 p) { return p + field.at(p) - target; };
    constexpr float kStep = 1;
    Vec2 p = start, r = residual(p);
    for (int k = 0; k < kNewtonSteps && glm::length(r) > kRootSettledPx; ++k) {
        const glm::mat2 slope(residual(p + Vec2(kStep, 0)) - r, residual(p + Vec2(0, kStep)) - r);
        if (!(std::abs(glm::determinant(slope)) > 1e-6f)) break;
        const Vec2 next = p - glm::inverse(slope) * r;
        const Vec2 left = residual(next);
        if (!(glm::length(left) < glm::length(r))) break;
        p = next, r = left;
    }
    return {p, glm::length(r)};
}

LatticeField coarse_inverse(const LatticeField& field) {
    constexpr int kCoarse = 16;
    return inverse(field.spacing() < kCoarse ? field.resampled(kCoarse) : field);
}

LatticeField through_reference(const LatticeField& ref_from_here,
                               const LatticeField& ref_from_there) {
    if (ref_from_there.spacing() < ref_from_here.spacing())
        return through_reference(ref_from_here.resampled(ref_from_there.spacing()), ref_from_there);
    LatticeField out(ref_from_here.full_size(), ref_from_here.spacing());
    const LatticeField there_from_ref = coarse_inverse(ref_from_there);
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i) {
            const Vec2 p = out.node_position(i, j), target = p + ref_from_here.node(i, j);
            // From where the inverse lattice says, and from where the neighbours went: within the
            // reference frame the first is near, beyond it the second.
            LatticeRoot best = root_of(ref_from_there, target, target + there_from_ref.at(target));
            const auto try_beside = [&](int x, int y) {
                if (best.miss <= kRootSettledPx || x < 0 || y < 0) return;
                const LatticeRoot other = root_of(ref_from_there, target, p + out.node(x, y));
                if (other.miss < best.miss) best = other;
            };
            try_beside(i - 1, j);
            try_beside(i, j - 1);
            out.set_node(i, j, best.place - p);
        }
    }
    return out;
}

}  // namespace weft

#pragma once
// The shape of a surface that moves as one rigid thing, as a function over the reference frame.

#include <vector>

#include "engine/core/geometry.h"
#include "engine/form/flat_plane.h"
#include "engine/form/metric_field.h"

namespace weft {

/// A surface in front of a pinhole camera by its nearness ρ, the reciprocal of its depth, over the
/// reference frame: ρ(x) = 1 + g·y + Σ c B(y), with y = (x − centre) / radius. A plane has no c:
/// its nearness is linear in the picture, whatever the focal length. The B are products of
/// Chebyshev polynomials over the square |y| ≤ reach, of total order 2 to kOrders. The unit of
/// length is the depth at the centre. Const access is thread-safe.
struct RigidSurface {
    static constexpr int kOrders = 5;

    Vec2 middle{0};                   ///< Of the picture, px: where the camera looks.
    double long_side = 1;             ///< Of the picture, px.
    double tangent = 1;               ///< Long side over focal length.
    Vec2 centre{0};                   ///< px
    double radius = 1;                ///< px
    double reach = 1;                 ///< Of the square, in radii.
    double slope_x = 0, slope_y = 0;  ///< g, by radius.
    std::vector<double> relief;       ///< c; empty: a plane.

    [[nodiscard]] static const std::vector<Vec2i>& orders();
    /// How much ρ changes at a place (px) by g.x, g.y and each c: 2 + relief.size() values.
    void nearness_terms(Vec2 place, double* out) const;
    [[nodiscard]] double nearness(Vec2 place) const;
    /// The first fundamental form at a place; not positive definite where ρ ≤ 0.
    [[nodiscard]] Metric metric(Vec2 place) const;
    /// The plane that it is without its relief, its slopes times `share`, 0 to 1: less tilted.
    [[nodiscard]] SeenPlane plane(double share) const;
};

}  // namespace weft

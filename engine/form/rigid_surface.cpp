#include "engine/form/rigid_surface.h"

#include <array>
#include <cstddef>

namespace weft {
namespace {

using Polynomials = std::array<double, RigidSurface::kOrders + 1>;

// Chebyshev's, by their recurrence.
Polynomials polynomials(double t) {
    Polynomials out{};
    out[0] = 1;
    out[1] = t;
    for (std::size_t k = 2; k < out.size(); ++k)
        out[k] = 2 * t * out[k - 1] - out[k - 2];
    return out;
}

}  // namespace

const std::vector<Vec2i>& RigidSurface::orders() {
    static const std::vector<Vec2i> all = [] {
        std::vector<Vec2i> out;
        for (int total = 2; total <= kOrders; ++total)
            for (int k = 0; k <= total; ++k)
                out.emplace_back(total - k, k);
        return out;
    }();
    return all;
}

void RigidSurface::nearness_terms(Vec2 place, double* out) const {
    const double x = (static_cast<double>(place.x) - centre.x) / radius,
                 y = (static_cast<double>(place.y) - centre.y) / radius;
    out[0] = x;
    out[1] = y;
    if (relief.empty()) return;
    const Polynomials along_x = polynomials(x / reach), along_y = polynomials(y / reach);
    for (std::size_t k = 0; k < relief.size(); ++k) {
        const Vec2i order = orders()[k];
        out[2 + k] =
            along_x[static_cast<std::size_t>(order.x)] * along_y[static_cast<std::size_t>(order.y)];
    }
}

double RigidSurface::nearness(Vec2 place) const {
    std::vector<double> terms(2 + relief.size());
    nearness_terms(place, terms.data());
    double out = 1 + slope_x * terms[0] + slope_y * terms[1];
    for (std::size_t k = 0; k < relief.size(); ++k)
        out += relief[k] * terms[2 + k];
    return out;
}

Metric RigidSurface::metric(Vec2 place) const {
    // P = r / ρ, so ∂P = (∂r − P ∂ρ) / ρ.
    constexpr float kHalf_px = 0.5f;
    const double rho = nearness(place);
    if (!(rho > 0)) return {};
    const double along_x =
        nearness(place + Vec2(kHalf_px, 0)) - nearness(place - Vec2(kHalf_px, 0));
    const double along_y =
        nearness(place + Vec2(0, kHalf_px)) - nearness(place - Vec2(0, kHalf_px));
    const double by = tangent / long_side;
    const double px = (static_cast<double>(place.x) - middle.x) * by / rho,
                 py = (static_cast<double>(place.y) - middle.y) * by / rho, pz = 1 / rho;
    const std::array<double, 3> x{(by - px * along_x) / rho, -py * along_x / rho,
                                  -pz * along_x / rho};
    const std::array<double, 3> y{-px * along_y / rho, (by - py * along_y) / rho,
                                  -pz * along_y / rho};
    const auto dot = [](const auto& a, const auto& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    return {dot(x, x), dot(x, y), dot(y, y)};
}

SeenPlane RigidSurface::plane(double share) const {
    const double focal = long_side / tangent;
    const double x = share * slope_x / radius, y = share * slope_y / radius;  // by pixel
    const glm::dvec2 off = glm::dvec2(middle) - glm::dvec2(centre);
    return {{x * focal, y * focal, 1 + x * off.x + y * off.y}, {focal, middle}};
}

}  // namespace weft

#include "engine/form/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/form/exact_math.h"

namespace weft {
namespace {

// Root mean square over places.
template <typename Each>
double rms_over(const std::vector<Vec2>& places, const Each& each) {
    double sum = 0;
    for (const Vec2 place : places) {
        const double v = each(place);
        sum += v * v;
    }
    return std::sqrt(sum / static_cast<double>(places.size()));
}

}  // namespace

double log_stretch_between(const Metric& a, const Metric& b) {
    const double area = a.determinant();
    if (!(area > 0) || !(b.determinant() > 0)) return kImpossibleStretch;
    const double half = (a.yy * b.xx - 2 * a.xy * b.xy + a.xx * b.yy) / (2 * area);
    const double root = std::sqrt(std::max(0.0, half * half - b.determinant() / area));
    return 0.5 * ln((half + root) / std::max(half - root, 1e-12 * half));
}

double log_stretch_between(const RigidSurface& a, const RigidSurface& b,
                           const std::vector<Vec2>& places) {
    return rms_over(places, [&](Vec2 p) { return log_stretch_between(a.metric(p), b.metric(p)); });
}

double log_stretch_of(const RigidSurface& surface, const std::vector<Vec2>& places) {
    return rms_over(places, [&](Vec2 p) {
        return log_stretch_between({1, 0, 1}, surface.metric(p));
    });
}

double tilt_of(const RigidSurface& surface) {
    return degrees_of_cosine(facing(surface.metric(surface.centre)));
}

double fov_of_tangent(double tangent, Size picture) {
    const long double half = 0.5L * static_cast<long double>(tangent) * picture.width /
                             std::max(picture.width, picture.height);
    return static_cast<double>(2 * std::atan(half) * 180 / std::numbers::pi_v<long double>);
}

}  // namespace weft

#include "engine/motion/photometric_register.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/motion/photometric_samples.h"
#include "engine/motion/plane_fit.h"

namespace weft {
namespace {

using Vec8 = std::array<double, 8>;
using Mat8 = std::array<Vec8, 8>;

// Solves a symmetric positive definite system in place. Returns false if it is not positive
// definite.
bool solve_cholesky(Mat8& a, Vec8& b) {
    for (std::size_t j = 0; j < 8; ++j) {
        for (std::size_t k = 0; k < j; ++k)
            a[j][j] -= a[j][k] * a[j][k];
        if (a[j][j] <= 1e-12) return false;
        a[j][j] = std::sqrt(a[j][j]);
        for (std::size_t i = j + 1; i < 8; ++i) {
            for (std::size_t k = 0; k < j; ++k)
                a[i][j] -= a[i][k] * a[j][k];
            a[i][j] /= a[j][j];
        }
    }
    for (std::size_t i = 0; i < 8; ++i) {
        for (std::size_t k = 0; k < i; ++k)
            b[i] -= a[i][k] * b[k];
        b[i] /= a[i][i];
    }
    for (std::size_t i = 8; i-- > 0;) {
        for (std::size_t k = i + 1; k < 8; ++k)
            b[i] -= a[k][i] * b[k];
        b[i] /= a[i][i];
    }
    return true;
}

// A homography in coordinates about `centre`, of about unit size, on both sides.
struct Homography {
    double cx = 0, cy = 0, radius = 1;
    Vec8 h{1, 0, 0, 0, 1, 0, 0, 0};  // row by row, the last entry is 1

    struct At {
        double x, y;             // frame coordinates
        double u, v, nx, ny, w;  // local coordinates in, local out, denominator
    };
    // The denominator is at least `nearest`.
    [[nodiscard]] At at(double x, double y,
                        double nearest = std::numeric_limits<double>::lowest()) const {
        At a{};
        a.u = (x - cx) / radius;
        a.v = (y - cy) / radius;
        a.w = std::max(nearest, h[6] * a.u + h[7] * a.v + 1);
        a.nx = (h[0] * a.u + h[1] * a.v + h[2]) / a.w;
        a.ny = (h[3] * a.u + h[4] * a.v + h[5]) / a.w;
        a.x = cx + radius * a.nx;
        a.y = cy + radius * a.ny;
        return a;
    }
};

// d(value)/dh from the value's gradient g (per pixel) at a.
Vec8 gradient_of(const Homography& map, const Homography::At& a, double gx, double gy) {
    const double s = map.radius / a.w, ax = gx * s, ay = gy * s;
    const double along = ax * a.nx + ay * a.ny;
    return {ax * a.u, ax * a.v, ax, ay * a.u, ay * a.v, ay, -along * a.u, -along * a.v};
}

// The homography nearest to a field at the samples, by linear least squares on the numerator
// (algebraic error; the photometric iterations that follow do not depend on it).
bool start_from(const LatticeField& field, const RegistrationSamples& samples, Homography& map) {
    Mat8 a{};
    Vec8 b{};
    for (std::size_t k = 0; k < samples.size(); k += 7) {
        const Vec2 p = samples.p[k], q = p + field.at(p);
        const double u = (p.x - map.cx) / map.radius, v = (p.y - map.cy) / map.radius;
        const double tx = (q.x - map.cx) / map.radius, ty = (q.y - map.cy) / map.radius;
        const std::array<Vec8, 2> rows{
            Vec8{u, v, 1, 0, 0, 0, -u * tx, -v * tx},
            Vec8{0, 0, 0, u, v, 1, -u * ty, -v * ty},
        };
        const std::array<double, 2> wanted{tx, ty};
        for (std::size_t r = 0; r < 2; ++r) {
            for (std::size_t i = 0; i < 8; ++i) {
                for (std::size_t j = 0; j <= i; ++j)
                    a[i][j] += rows[r][i] * rows[r][j];
                b[i] += rows[r][i] * wanted[r];
            }
        }
    }
    const double ridge = 1e-6 * static_cast<double>(samples.size());
    a[6][6] += ridge;
    a[7][7] += ridge;
    for (std::size_t i = 0; i < 8; ++i)
        a[i][i] += 1e-12 * static_cast<double>(samples.size());
    if (!solve_cholesky(a, b)) return false;
    map.h = b;
    return true;
}

// `samples`: what the map was fitted to.
LatticeField field_of(const Homography& map, const RegistrationSamples& samples,
                      const LatticeField& like) {
    constexpr std::size_t kEvery = 31;
    std::vector<double> depths;
    for (std::size_t k = 0; k < samples.size(); k += kEvery)
        depths.push_back(map.at(samples.p[k].x, samples.p[k].y).w);
    const double nearest = nearest_depth(std::move(depths));
    LatticeField out(like.full_size(), like.spacing());
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i) {
            const Vec2 p = out.node_position(i, j);
            const auto a = map.at(p.x, p.y, nearest);
            out.set_node(i, j, Vec2(static_cast<float>(a.x) - p.x, static_cast<float>(a.y) - p.y));
        }
    }
    return out;
}

// The normal equations of some residuals.
struct Normal {
    Mat8 a{};
    Vec8 b{}, noise{};  // of the residuals; of their noise for a variance of 1
    NoiseInResiduals in_residuals;

    void add(const Homography& map, const RegistrationResidual& t, double scale) {
        const double w = cauchy(t.r / scale);
        const auto at = map.at(t.p.x, t.p.y);
        const Vec8 j = gradient_of(map, at, t.gradient.x, t.gradient.y);
        const Vec8 of_noise = gradient_of(map, at, t.noise.x, t.noise.y);
        for (std::size_t i = 0; i < 8; ++i) {
            const double wj = w * j[i];
            for (std::size_t k = 0; k <= i; ++k)
                a[i][k] += wj * j[k];
            b[i] -= wj * t.r;
            noise[i] += w * of_noise[i];
        }
        in_residuals.add(t, w);
    }
    void add(const Normal& other) {
        for (std::size_t i = 0; i < 8; ++i) {
            for (std::size_t k = 0; k <= i; ++k)
                a[i][k] += other.a[i][k];
            b[i] += other.b[i];
            noise[i] += other.noise[i];
        }
        in_residuals.add(other.in_residuals);
    }
    // Without what interpolation makes of noise; with `near` that of the gradients, too, which is
    // right near the solution: farther off, differences are more than noise.
    void take_off_noise(double spread, bool near) {
        const double half = 0.5 * in_residuals.variance(),
                     left = near ? in_residuals.structure(spread) : 1;
        for (std::size_t i = 0; i < 8; ++i) {
            for (std::size_t k = 0; k <= i; ++k)
                a[i][k] *= left * left;
            b[i] = left * (b[i] + half * noise[i]);
        }
    }
};

Normal normal_of(const Homography& map, const std::vector<RegistrationResidual>& residuals,
                 double scale, bool near) {
    constexpr std::size_t kChunk = 4096;
    std::vector<Normal> parts((residuals.size() + kChunk - 1) / kChunk);
    parallel_for(parts.size(), [&](std::size_t part) {
        const std::size_t end = std::min(residuals.size(), (part + 1) * kChunk);
        for (std::size_t k = part * kChunk; k < end; ++k)
            parts[part].add(map, residuals[k], scale);
    });
    Normal sum;
    for (const Normal& part : parts)
        sum.add(part);
    sum.take_off_noise(scale, near);
    return sum;
}

std::vector<Vec2> places_under(const Homography& map, const RegistrationSamples& samples) {
    constexpr float kNowhere = -1e6f;  // beyond the horizon
    std::vector<Vec2> places;
    places.reserve(samples.size());
    for (const Vec2 p : samples.p) {
        const auto a = map.at(p.x, p.y);
        places.push_back(a.w < 0.05 ? Vec2(kNowhere)
                                    : Vec2(static_cast<float>(a.x), static_cast<float>(a.y)));
    }
    return places;
}

// A prior that limits perspective to about a tenth over the region. `weight`: of each sample.
void add_prior(Normal& normal, const Homography& map, double scale, double weight) {
    const double prior = 100 * scale * scale / weight;
    normal.a[6][6] += prior;
    normal.a[7][7] += prior;
    normal.b[6] -= prior * map.h[6];
    normal.b[7] -= prior * map.h[7];
    for (std::size_t i = 0; i < 8; ++i)
        normal.a[i][i] *= 1 + 1e-9;
}

// One Gauss–Newton step. Returns how far the samples move at most, px; negative: no solution.
double planar_step(const RegistrationPicture& anchor, const RegistrationSamples& samples,
                   const InterpolationNoise& noise, bool near, Homography& map) {
    const auto residuals = residuals_at(anchor, samples, places_under(map, samples), noise);
    if (residuals.size() < 200) return -1;
    const double scale = robust_spread(residuals);
    Normal normal = normal_of(map, residuals, scale, near);
    add_prior(normal, map, scale, samples.weight);
    Vec8& b = normal.b;
    if (!solve_cholesky(normal.a, b)) return -1;
    double most = 0;
    for (std::size_t i = 0; i < 8; ++i) {
        map.h[i] += b[i];
        most = std::max(most, std::abs(b[i]) * map.radius);
    }
    return most;
}

// The standard error of the map that the noise of the samples leaves, px: the root of its mean
// square over the samples.
double standard_error(const RegistrationPicture& anchor, const RegistrationSamples& samples,
                      const InterpolationNoise& noise, const Homography& map) {
    const auto residuals = residuals_at(anchor, samples, places_under(map, samples), noise);
    if (residuals.empty()) return 0;
    const double scale = robust_spread(residuals);
    Normal normal = normal_of(map, residuals, scale, true);
    add_prior(normal, map, scale, samples.weight);
    constexpr std::size_t kEvery = 97;
    double sum = 0, n = 0;
    for (std::size_t k = 0; k < samples.size(); k += kEvery, ++n) {
        const auto at = map.at(samples.p[k].x, samples.p[k].y);
        for (const double along_x : {1.0, 0.0}) {
            const Vec8 j = gradient_of(map, at, along_x, 1 - along_x);
            Mat8 a = normal.a;
            Vec8 solved = j;
            if (!solve_cholesky(a, solved)) return 0;
            for (std::size_t i = 0; i < 8; ++i)
                sum += j[i] * solved[i];
        }
    }
    return n > 0 ? scale * std::sqrt(sum / n) : 0;
}

Homography about(const RegistrationPicture& cur) {
    Homography map;
    map.cx = 0.5 * (cur.area.x0 + cur.area.x1);
    map.cy = 0.5 * (cur.area.y0 + cur.area.y1);
    map.radius = std::max(8.0, 0.5 * std::max(cur.area.width(), cur.area.height()));
    return map;
}

constexpr double kStill = 0.003;  // px: converged
// A homography moves farther in its corners than each of its entries, of which this is the most.
constexpr double kOfLattice = 0.3;

}  // namespace

PlanarRegistration register_planar(const RegistrationPicture& anchor,
                                   const RegistrationPicture& cur, const LatticeField& initial,
                                   const RegistrationOptions& options) {
    PlanarRegistration out{initial, {}, false};
    const RegistrationSamples samples = registration_samples(cur, options.samples, options.thinned);
    if (samples.size() < 500) return out;
    Homography map = about(cur);
    if (!start_from(initial, samples, map)) return out;
    const InterpolationNoise noise = noise_between(anchor, cur, initial);
    double moved = 1;
    for (int k = 0; k < options.iterations && moved > kOfLattice * options.still_px; ++k) {
        moved = planar_step(anchor, samples, noise, false, map);
        if (moved < 0 || moved > 50) return out;
    }
    out.anchor_from_cur = field_of(map, samples, initial);
    out.fit = registration_fit(anchor, cur, out.anchor_from_cur, options);
    out.found = true;
    return out;
}

LatticeField refine_planar(const RegistrationPicture& anchor, const RegistrationPicture& cur,
                           const LatticeField& found, const RegistrationOptions& options) {
    constexpr double kWanted_px = 0.01, kFarthest_px = 1;
    constexpr double kMost = 400000;
    constexpr int kPlanarRounds = 4;
    const RegistrationSamples samples = registration_samples(cur, options.samples);
    Homography map = about(cur);
    if (!start_from(found, samples, map)) return found;
    const InterpolationNoise noise = noise_between(anchor, cur, found);
    const double error = standard_error(anchor, samples, noise, map) / kWanted_px;
    if (error <= 1) return found;
    const auto wanted = static_cast<int>(std::min(kMost, error * error * options.samples));
    const RegistrationSamples more = registration_samples(cur, wanted);
    if (more.size() <= samples.size()) return found;
    double moved = 1;
    for (int k = 0; k < kPlanarRounds && moved > kStill; ++k) {
        moved = planar_step(anchor, more, noise, true, map);
        if (moved < 0 || moved > kFarthest_px) return found;
    }
    return field_of(map, samples, found);
}

}  // namespace weft

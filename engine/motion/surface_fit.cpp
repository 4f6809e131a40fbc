#include "engine/motion/surface_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/motion/view_mat.h"

namespace weft {
namespace {

struct Sample {
    Vec2 p;        // where, frame coordinates
    Vec2 d;        // raw motion there
    float weight;  // 0–1
};

// Standard deviation (per component) of a set of residuals, from the median of their norms.
float robust_scale(const std::vector<Sample>& samples, const std::vector<Vec2>& residuals) {
    std::vector<float> norms;
    norms.reserve(residuals.size());
    for (std::size_t i = 0; i < residuals.size(); ++i) {
        if (samples[i].weight > 0.1f) norms.push_back(glm::length(residuals[i]));
    }
    if (norms.empty()) return 0;
    const auto middle = norms.begin() + static_cast<std::ptrdiff_t>(norms.size() / 2);
    std::nth_element(norms.begin(), middle, norms.end());
    // The median norm of a 2D Gaussian is 1.177 σ.
    return *middle / 1.177f;
}

// Solves the symmetric n×n system in place by Gaussian elimination with a ridge already added;
// `rhs` holds two right-hand sides. Returns false when it is singular.
template <std::size_t N>
bool solve_with_pivots(std::array<std::array<double, N>, N>& a,
                       std::array<std::array<double, 2>, N>& rhs) {
    for (std::size_t k = 0; k < N; ++k) {
        std::size_t pivot = k;
        for (std::size_t r = k + 1; r < N; ++r) {
            if (std::abs(a[r][k]) > std::abs(a[pivot][k])) pivot = r;
        }
        if (std::abs(a[pivot][k]) < 1e-12) return false;
        std::swap(a[k], a[pivot]);
        std::swap(rhs[k], rhs[pivot]);
        for (std::size_t r = 0; r < N; ++r) {
            if (r == k) continue;
            const double f = a[r][k] / a[k][k];
            for (std::size_t c = k; c < N; ++c)
                a[r][c] -= f * a[k][c];
            for (std::size_t c = 0; c < 2; ++c)
                rhs[r][c] -= f * rhs[k][c];
        }
    }
    for (std::size_t k = 0; k < N; ++k) {
        for (std::size_t c = 0; c < 2; ++c)
            rhs[k][c] /= a[k][k];
    }
    return true;
}

// The region's centre and half extent, which keep polynomials well conditioned.
struct Frame2D {
    Vec2 centre{0};
    float radius = 1;
    [[nodiscard]] Vec2 local(Vec2 p) const { return (p - centre) / radius; }
};

Frame2D frame_of(const std::vector<Sample>& samples) {
    double sum = 0, x = 0, y = 0, xx = 0, yy = 0;
    for (const Sample& s : samples) {
        sum += s.weight;
        x += s.weight * s.p.x;
        y += s.weight * s.p.y;
        xx += static_cast<double>(s.weight) * s.p.x * s.p.x;
        yy += static_cast<double>(s.weight) * s.p.y * s.p.y;
    }
    const double mx = x / sum, my = y / sum;
    const double variance = (xx / sum - mx * mx) + (yy / sum - my * my);
    return {{static_cast<float>(mx), static_cast<float>(my)},
            static_cast<float>(std::max(4.0, 1.5 * std::sqrt(std::max(0.0, variance))))};
}

using Quadratic = std::array<std::array<double, 2>, 6>;

std::array<double, 6> quadratic_basis(Vec2 q) {
    return {1.0,
            q.x,
            q.y,
            static_cast<double>(q.x) * q.x,
            static_cast<double>(q.x) * q.y,
            static_cast<double>(q.y) * q.y};
}

Vec2 evaluate(const Quadratic& model, Vec2 q) {
    const auto b = quadratic_basis(q);
    double u = 0, v = 0;
    for (std::size_t k = 0; k < 6; ++k) {
        u += model[k][0] * b[k];
        v += model[k][1] * b[k];
    }
    return {static_cast<float>(u), static_cast<float>(v)};
}

// The quadratic inside the region's extent, its tangent beyond: a parabola is not reliable far from
// its data.
Vec2 evaluate_tamed(const Quadratic& model, Vec2 q) {
    constexpr float kReach = 1.6f;
    const float r = glm::length(q);
    if (r <= kReach) return evaluate(model, q);
    const Vec2 edge = q * (kReach / r);
    constexpr float kStep = 0.05f;
    const Vec2 slope =
        (evaluate(model, edge) - evaluate(model, edge * (1 - kStep / kReach))) / kStep;
    return evaluate(model, edge) + slope * (r - kReach);
}

// Iteratively reweighted least squares with Cauchy weights (as in Black & Anandan 1996).
Quadratic fit_quadratic(const std::vector<Sample>& samples, const Frame2D& frame) {
    Quadratic model{};
    std::vector<Vec2> residuals(samples.size());
    float scale = 1e6f;
    for (int iteration = 0; iteration < 7; ++iteration) {
        std::array<std::array<double, 6>, 6> a{};
        Quadratic rhs{};
        double total = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const Sample& s = samples[i];
            const float r = glm::length(residuals[i]) / scale;
            const double w = iteration == 0 ? s.weight : s.weight / (1 + r * r);
            const auto b = quadratic_basis(frame.local(s.p));
            total += w;
            for (std::size_t j = 0; j < 6; ++j) {
                for (std::size_t k = 0; k <= j; ++k)
                    a[j][k] += w * b[j] * b[k];
                rhs[j][0] += w * b[j] * s.d.x;
                rhs[j][1] += w * b[j] * s.d.y;
            }
        }
        // A faint ridge on the slopes and a stronger one on the curvature, because a sliver of
        // surface determines neither across it.
        constexpr std::array<double, 6> kRidge{1e-9, 1e-4, 1e-4, 1e-3, 1e-3, 1e-3};
        for (std::size_t j = 0; j < 6; ++j) {
            for (std::size_t k = j + 1; k < 6; ++k)
                a[j][k] = a[k][j];
            a[j][j] += kRidge[j] * total;
        }
        if (!solve_with_pivots<6>(a, rhs)) return model;
        model = rhs;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            residuals[i] = samples[i].d - evaluate(model, frame.local(samples[i].p));
        }
        scale = std::max(0.02f, 1.5f * robust_scale(samples, residuals));
    }
    return model;
}

// Weighted sums of a cell or, once blurred, of a neighbourhood: all that an affine fit of two
// components needs.
enum Moment { kW, kWx, kWy, kWxx, kWxy, kWyy, kU, kUx, kUy, kV, kVx, kVy, kMoments };
using Moments = Image<double, kMoments>;

// Separable Gaussian of σ = 2 nodes.
void blur(Moments& m) {
    constexpr int kRadius = 6;
    std::array<double, 2 * kRadius + 1> g{};
    for (int k = -kRadius; k <= kRadius; ++k) {
        // Long double: see docs/decisions/0002-determinism.md.
        g[static_cast<std::size_t>(k + kRadius)] =
            static_cast<double>(std::exp(-0.5L * k * k / 4.0L));
    }
    Moments t(m.size());
    for (int y = 0; y < m.height(); ++y) {
        for (int x = 0; x < m.width(); ++x) {
            double* out = t.pixel(x, y);
            for (int k = std::max(-kRadius, -x); k <= std::min(kRadius, m.width() - 1 - x); ++k) {
                const double* in = m.pixel(x + k, y);
                const double w = g[static_cast<std::size_t>(k + kRadius)];
                for (int c = 0; c < kMoments; ++c)
                    out[c] += w * in[c];
            }
        }
    }
    for (int y = 0; y < m.height(); ++y) {
        double* const row = m.row(y);
        std::fill(row, row + m.stride(), 0.0);
        for (int k = std::max(-kRadius, -y); k <= std::min(kRadius, m.height() - 1 - y); ++k) {
            const double* in = t.row(y + k);
            const double w = g[static_cast<std::size_t>(k + kRadius)];
            for (std::ptrdiff_t c = 0; c < m.stride(); ++c)
                row[c] += w * in[c];
        }
    }
}

// The local affine fit's value at the node itself, from moments about the frame's origin.
Vec2 affine_at_node(const double* m, Vec2 node, double sigma) {
    const double qx = node.x, qy = node.y, w = m[kW];
    const double mx = (m[kWx] - qx * w) / sigma, my = (m[kWy] - qy * w) / sigma;
    const double s2 = sigma * sigma;
    const double mxx = (m[kWxx] - 2 * qx * m[kWx] + qx * qx * w) / s2;
    const double myy = (m[kWyy] - 2 * qy * m[kWy] + qy * qy * w) / s2;
    const double mxy = (m[kWxy] - qx * m[kWy] - qy * m[kWx] + qx * qy * w) / s2;
    // A ridge limits the slope where the neighbourhood is one-sided.
    const double ridge = 0.15 * w;
    std::array<std::array<double, 3>, 3> a{
        {{w, mx, my}, {mx, mxx + ridge, mxy}, {my, mxy, myy + ridge}}};
    std::array<std::array<double, 2>, 3> rhs{
        {{m[kU], m[kV]},
         {(m[kUx] - qx * m[kU]) / sigma, (m[kVx] - qx * m[kV]) / sigma},
         {(m[kUy] - qy * m[kU]) / sigma, (m[kVy] - qy * m[kV]) / sigma}}};
    if (!solve_with_pivots<3>(a, rhs)) return Vec2(0);
    return {static_cast<float>(rhs[0][0]), static_cast<float>(rhs[0][1])};
}

// One level: local affine fits of σ = 2 · spacing to the residuals, on a lattice of that spacing.
struct Level {
    LatticeField correction;
    ImageF1 support;  // Σ g·w at each node, in samples
};

Level fit_level(const std::vector<Sample>& samples, const std::vector<Vec2>& residuals, Size full,
                int spacing, float scale) {
    Level level{LatticeField(full, spacing), {}};
    const ImageF2& nodes = level.correction.nodes();
    Moments m(nodes.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Sample& s = samples[i];
        const int nx = static_cast<int>(std::lround(s.p.x / static_cast<float>(spacing))) +
                       LatticeField::kMargin;
        const int ny = static_cast<int>(std::lround(s.p.y / static_cast<float>(spacing))) +
                       LatticeField::kMargin;
        const float r = glm::length(residuals[i]) / scale;
        const double w = s.weight / (1 + r * r);
        const double x = s.p.x, y = s.p.y, u = w * residuals[i].x, v = w * residuals[i].y;
        double* const c = m.pixel(nx, ny);
        c[kW] += w;
        c[kWx] += w * x;
        c[kWy] += w * y;
        c[kWxx] += w * x * x;
        c[kWxy] += w * x * y;
        c[kWyy] += w * y * y;
        c[kU] += u;
        c[kUx] += u * x;
        c[kUy] += u * y;
        c[kV] += v;
        c[kVx] += v * x;
        c[kVy] += v * y;
    }
    blur(m);
    level.support = ImageF1(nodes.size());
    for (int j = 0; j < nodes.height(); ++j) {
        for (int i = 0; i < nodes.width(); ++i) {
            const double* c = m.pixel(i, j);
            level.support.at(i, j) = static_cast<float>(c[kW]);
            if (c[kW] < 1e-3) continue;
            level.correction.set_node(
                i, j, affine_at_node(c, level.correction.node_position(i, j), 2.0 * spacing));
        }
    }
    return level;
}

// Shrinks a level to what exceeds the noise: δ · τ² / (τ² + se²). se² is the local fit's own
// variance. τ², how much this surface really deviates from the stiffer model at this level, is
// estimated from all nodes together (empirical Bayes), by a quantile. Example: a rolling ball's
// shadow moves across the ground, and only the rest of the ground shows that the ground does not
// move with it.
void shrink(Level& level, float noise, float samples_per_independent) {
    const auto variance_at = [&](int i, int j) {
        // For Gaussian weights the effective number of samples is (Σg)²/Σg² = 2 Σg.
        const float n = 2 * level.support.at(i, j) / samples_per_independent;
        return noise * noise / std::max(n, 1e-4f);
    };
    std::vector<float> deviations;
    for (int j = 0; j < level.support.height(); ++j) {
        for (int i = 0; i < level.support.width(); ++i) {
            const Vec2 delta = level.correction.node(i, j);
            const float own = variance_at(i, j);
            if (own > noise * noise) continue;
            // The three-quarter quantile of |δ|² is 2.77 times the variance of a component.
            deviations.push_back(glm::dot(delta, delta) / 2.77f - own);
        }
    }
    float deviation = 0;
    if (!deviations.empty()) {
        const auto at = deviations.begin() + static_cast<std::ptrdiff_t>(3 * deviations.size() / 4);
        std::nth_element(deviations.begin(), at, deviations.end());
        deviation = std::max(0.0f, *at);
    }
    for (int j = 0; j < level.support.height(); ++j) {
        for (int i = 0; i < level.support.width(); ++i) {
            const float share = deviation / (deviation + variance_at(i, j) + 1e-12f);
            level.correction.set_node(i, j, share * level.correction.node(i, j));
        }
    }
}

void subtract(const std::vector<Sample>& samples, const LatticeField& field,
              std::vector<Vec2>& residuals) {
    for (std::size_t i = 0; i < samples.size(); ++i)
        residuals[i] -= field.at(samples[i].p);
}

std::vector<Sample> take_samples(ViewF2 flow, ViewU8x1 weights, int stride) {
    std::vector<Sample> samples;
    for (int y = stride / 2; y < flow.height(); y += stride) {
        for (int x = stride / 2; x < flow.width(); x += stride) {
            const std::uint8_t w = weights.at(x, y);
            const float* d = flow.pixel(x, y);
            if (w == 0 || !std::isfinite(d[0]) || !std::isfinite(d[1])) continue;
            samples.push_back({{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f},
                               {d[0], d[1]},
                               static_cast<float>(w) / 255.0f});
        }
    }
    return samples;
}

}  // namespace

LatticeField fit_surface_motion(ViewF2 flow, ViewU8x1 weights, const SurfaceFitOptions& options) {
    const Size full = flow.size();
    LatticeField field(full, options.spacing_px);
    // Two samples a side for what is correlated.
    const int stride = std::max(1, static_cast<int>(options.correlation_px) / 2);
    const std::vector<Sample> samples = take_samples(flow, weights, stride);
    if (samples.size() < 3) return field;

    // The stiff model.
    const Frame2D frame = frame_of(samples);
    const Quadratic model = fit_quadratic(samples, frame);
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            field.set_node(i, j, evaluate_tamed(model, frame.local(field.node_position(i, j))));
        }
    }
    std::vector<Vec2> residuals(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
        residuals[i] = samples[i].d;
    subtract(samples, field, residuals);

    // The noise of the raw motion is what even the finest fit leaves, and half of it again, because
    // the estimator's errors are correlated over about the width of that fit and are partly
    // followed.
    const int finest =
        std::max(options.spacing_px / 2, static_cast<int>(std::lround(options.finest_px / 2)));
    const float spread = std::max(options.noise_floor_px, robust_scale(samples, residuals));
    std::vector<Vec2> left = residuals;
    subtract(samples, fit_level(samples, residuals, full, finest, 3 * spread).correction, left);
    const float noise = std::max(options.noise_floor_px, 1.5f * robust_scale(samples, left));

    // Corrections, from wide to narrow support.
    const float correlation = std::max(1.0f, options.correlation_px / static_cast<float>(stride));
    const float samples_per_independent = correlation * correlation;
    for (int spacing = 8 * finest; spacing >= finest; spacing /= 2) {
        const float scale = 3 * std::max(noise, robust_scale(samples, residuals));
        Level level = fit_level(samples, residuals, full, spacing, scale);
        shrink(level, noise, samples_per_independent);
        subtract(samples, level.correction, residuals);
        const LatticeField step = level.correction.resampled(options.spacing_px);
        for (int j = 0; j < field.nodes().height(); ++j) {
            for (int i = 0; i < field.nodes().width(); ++i) {
                field.set_node(i, j, field.node(i, j) + step.node(i, j));
            }
        }
    }
    return field;
}

Matte motion_weights(ViewU8x1 luma, ViewU8x1 visible, ViewU8x1 valid, int border_px) {
    cv::Mat inside = as_mat(visible) >= 128;
    // The frame's border is not the surface's border, so only the matte's own edge is avoided.
    cv::Mat distance, framed;
    cv::copyMakeBorder(inside, framed, 1, 1, 1, 1, cv::BORDER_REPLICATE);
    cv::distanceTransform(framed, distance, cv::DIST_L2, 3);
    distance = distance(cv::Rect(1, 1, inside.cols, inside.rows));
    // The border narrows in a thin region until a third of the region remains.
    double border = border_px;
    const int area = cv::countNonZero(inside);
    while (border > 1 && cv::countNonZero(distance > border) * 3 < area)
        border /= 2;

    cv::Mat gx, gy, energy;
    cv::Sobel(as_mat(luma), gx, CV_16S, 1, 0, 3, 1.0, 0, cv::BORDER_REPLICATE);
    cv::Sobel(as_mat(luma), gy, CV_16S, 0, 1, 3, 1.0, 0, cv::BORDER_REPLICATE);
    energy = cv::abs(gx) + cv::abs(gy);
    cv::boxFilter(energy, energy, CV_32F, {9, 9}, {-1, -1}, true, cv::BORDER_REPLICATE);

    Matte out(visible.size());
    for (int y = 0; y < out.height(); ++y) {
        const float* d = distance.ptr<float>(y);
        const float* e = energy.ptr<float>(y);
        for (int x = 0; x < out.width(); ++x) {
            if (d[x] <= border || valid.at(x, y) == 0) continue;
            // Sobel's sum of 24 is a slope of about 3 levels per pixel: half the weight.
            const float confidence = e[x] / (e[x] + 24.0f);
            out.at(x, y) = static_cast<std::uint8_t>(std::lround(10 + 245 * confidence));
        }
    }
    return out;
}

}  // namespace weft

#include "engine/mask/local_color.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr float kNoiseVariance = 9;  // 8-bit levels²: the least variance, for flat areas
constexpr std::size_t kMinSamples = 12;

float squared(Vec3 v) {
    return glm::dot(v, v);
}

// Seeds far from each other: the mean first, then repeatedly the sample that is covered worst.
std::vector<Vec3> spread_seeds(const std::vector<Vec3>& samples, int count) {
    Vec3 mean(0);
    for (const Vec3& s : samples)
        mean += s;
    std::vector<Vec3> seeds{mean / static_cast<float>(samples.size())};
    std::vector<float> cover(samples.size(), std::numeric_limits<float>::max());
    while (static_cast<int>(seeds.size()) < count) {
        // Not the farthest sample, which may be an outlier, but the one at the 90 % rank of a
        // coarse pass.
        float mean_cover = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            cover[i] = std::min(cover[i], squared(samples[i] - seeds.back()));
            mean_cover += cover[i];
        }
        mean_cover /= static_cast<float>(samples.size());
        Vec3 sum(0);
        float n = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            if (cover[i] <= 2 * mean_cover) continue;
            if (n > 0 && squared(samples[i] - sum / n) > 2 * mean_cover) continue;
            sum += samples[i];
            n += 1;
        }
        if (n < 2 || mean_cover < kNoiseVariance) break;
        seeds.push_back(sum / n);
    }
    return seeds;
}

}  // namespace

void ColorMixture::fit(const std::vector<Vec3>& samples, const std::vector<float>& weights) {
    count_ = 0;
    if (samples.size() < kMinSamples) return;
    std::vector<Vec3> means = spread_seeds(samples, kComponents);
    const int k = static_cast<int>(means.size());
    std::vector<std::uint8_t> owner(samples.size(), 0);
    for (int pass = 0; pass < 4; ++pass) {
        std::array<Vec3, kComponents> sum{};
        std::array<float, kComponents> n{};
        for (std::size_t i = 0; i < samples.size(); ++i) {
            int best = 0;
            float best_d = std::numeric_limits<float>::max();
            for (int j = 0; j < k; ++j) {
                const float d = squared(samples[i] - means[static_cast<std::size_t>(j)]);
                if (d < best_d) best_d = d, best = j;
            }
            owner[i] = static_cast<std::uint8_t>(best);
            sum[static_cast<std::size_t>(best)] += samples[i] * weights[i];
            n[static_cast<std::size_t>(best)] += weights[i];
        }
        for (std::size_t j = 0; j < means.size(); ++j) {
            if (n[j] > 0) means[j] = sum[j] / n[j];
        }
    }
    std::array<std::array<float, 6>, kComponents> cov{};
    std::array<float, kComponents> n{};
    float total = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::size_t j = owner[i];
        const Vec3 d = samples[i] - means[j];
        const float w = weights[i];
        cov[j][0] += w * d.x * d.x, cov[j][1] += w * d.x * d.y, cov[j][2] += w * d.x * d.z;
        cov[j][3] += w * d.y * d.y, cov[j][4] += w * d.y * d.z, cov[j][5] += w * d.z * d.z;
        n[j] += w;
        total += w;
    }
    for (std::size_t j = 0; j < means.size(); ++j) {
        if (n[j] < 0.01f * total) continue;
        const float inv_n = 1 / n[j];
        const float a = cov[j][0] * inv_n + kNoiseVariance, b = cov[j][1] * inv_n,
                    c = cov[j][2] * inv_n, d = cov[j][3] * inv_n + kNoiseVariance,
                    e = cov[j][4] * inv_n, f = cov[j][5] * inv_n + kNoiseVariance;
        const float det = a * (d * f - e * e) - b * (b * f - c * e) + c * (b * e - c * d);
        if (!(det > 0)) continue;
        Component& out = components_[static_cast<std::size_t>(count_++)];
        const float s = 1 / det;
        out.mean = means[j];
        out.inverse = {(d * f - e * e) * s, (c * e - b * f) * s, (b * e - c * d) * s,
                       (a * f - c * c) * s, (b * c - a * e) * s, (a * d - b * b) * s};
        out.scale = n[j] / total / std::sqrt(det);
    }
}

float ColorMixture::density(Vec3 color) const {
    float sum = 0;
    for (int j = 0; j < count_; ++j) {
        const Component& g = components_[static_cast<std::size_t>(j)];
        const Vec3 d = color - g.mean;
        const auto& m = g.inverse;
        const float q = m[0] * d.x * d.x + m[3] * d.y * d.y + m[5] * d.z * d.z +
                        2 * (m[1] * d.x * d.y + m[2] * d.x * d.z + m[4] * d.y * d.z);
        if (q < 60) sum += g.scale * std::exp(-0.5f * q);
    }
    return sum;
}

namespace {

// The least density of both sides, so that a colour that neither has shown decides nothing.
constexpr float kOutlierDensity = 5e-8f;

float inside_probability(const ColorWindow& w, Vec3 color) {
    if (w.inside.empty() || w.outside.empty()) return 0.5f;
    const float f = w.inside.density(color) + kOutlierDensity;
    const float b = w.outside.density(color) + kOutlierDensity;
    return f / (f + b);
}

struct Samples {
    std::vector<Vec3> inside, outside;
    std::vector<float> inside_weight, outside_weight;
};

template <class Visit>
void visit_window(const ColorSource& source, Vec2i c, int half, int stride, Visit&& visit) {
    const int x0 = std::max(0, c.x - half), x1 = std::min(source.frame.width() - 1, c.x + half);
    const int y0 = std::max(0, c.y - half), y1 = std::min(source.frame.height() - 1, c.y + half);
    for (int y = y0; y <= y1; y += stride) {
        const float* phi = source.phi.row(y);
        for (int x = x0; x <= x1; x += stride) {
            if (std::abs(phi[x]) < source.clearance_px) continue;
            const std::uint8_t* p = source.frame.pixel(x, y);
            visit(Vec3(p[0], p[1], p[2]), phi[x]);
        }
    }
}

void fit_window(ColorWindow& window, const std::vector<ColorSource>& sources, int half,
                int stride) {
    Samples s;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        visit_window(sources[i], window.source_centers[i], half, stride, [&](Vec3 c, float phi) {
            const float weight = phi > 0 ? sources[i].inside_weight : sources[i].outside_weight;
            if (weight <= 0) return;
            (phi > 0 ? s.inside : s.outside).push_back(c);
            (phi > 0 ? s.inside_weight : s.outside_weight).push_back(weight);
        });
    }
    window.inside.fit(s.inside, s.inside_weight);
    window.outside.fit(s.outside, s.outside_weight);
    if (window.inside.empty() || window.outside.empty()) return;
    // SnapCut eq. 2: the classifier's error where the answer is known. The boundary counts most.
    double error = 0, total = 0;
    const float sigma = 0.5f * static_cast<float>(half);
    visit_window(sources[0], window.source_centers[0], half, 2 * stride, [&](Vec3 c, float phi) {
        const float weight = std::exp(-phi * phi / (sigma * sigma));
        const float p = inside_probability(window, c);
        error += static_cast<double>(weight * (phi > 0 ? 1 - p : p));
        total += static_cast<double>(weight);
    });
    window.separability = total > 0 ? static_cast<float>(1 - error / total) : 0.0f;
}

}  // namespace

LocalColorField::LocalColorField(std::vector<ColorWindow> windows,
                                 const std::vector<ColorSource>& sources, int half_px, int stride,
                                 Size size)
    : windows_(std::move(windows)), half_px_(half_px) {
    parallel_for(windows_.size(),
                 [&](std::size_t i) { fit_window(windows_[i], sources, half_px, stride); });
    index_windows(size);
}

void LocalColorField::index_windows(Size size) {
    cells_wide_ = (size.width + kCell - 1) / kCell;
    const int cells_high = (size.height + kCell - 1) / kCell;
    const auto cells = static_cast<std::size_t>(cells_wide_) * static_cast<std::size_t>(cells_high);
    nearest_.assign(cells, {-1, -1, -1, -1});
    std::vector<std::array<int, 4>> distance(cells, {0, 0, 0, 0});
    for (std::size_t i = 0; i < windows_.size(); ++i) {
        const Vec2i c = windows_[i].center;
        const int x0 = std::max(0, (c.x - half_px_) / kCell),
                  y0 = std::max(0, (c.y - half_px_) / kCell);
        const int x1 = std::min(cells_wide_ - 1, (c.x + half_px_) / kCell);
        const int y1 = std::min(cells_high - 1, (c.y + half_px_) / kCell);
        for (int cy = y0; cy <= y1; ++cy) {
            for (int cx = x0; cx <= x1; ++cx) {
                const int dx = cx * kCell + kCell / 2 - c.x, dy = cy * kCell + kCell / 2 - c.y;
                const int d = dx * dx + dy * dy;
                const auto cell = static_cast<std::size_t>(cy * cells_wide_ + cx);
                auto& ids = nearest_[cell];
                auto& ds = distance[cell];
                int at =
                    4;  // insertion into the four nearest; a tie keeps the lower index in front
                while (at > 0 && (ids[static_cast<std::size_t>(at - 1)] < 0 ||
                                  ds[static_cast<std::size_t>(at - 1)] > d)) {
                    --at;
                }
                if (at == 4) continue;
                const auto place = static_cast<std::size_t>(at);
                for (std::size_t j = 3; j > place; --j)
                    ids[j] = ids[j - 1], ds[j] = ds[j - 1];
                ids[place] = static_cast<int>(i);
                ds[place] = d;
            }
        }
    }
}

float ColorProbability::confidence() const {
    constexpr float kFrom = 0.6f, kRange = 0.35f;  // of the separability
    return std::clamp((separability - kFrom) / kRange, 0.0f, 1.0f);
}

ColorProbability LocalColorField::at(int x, int y, Vec3 color) const {
    if (!left_out_.empty() && left_out_.at(x, y) != 0) return {};
    const auto& ids = nearest_[static_cast<std::size_t>((y / kCell) * cells_wide_ + x / kCell)];
    float p = 0, s = 0, total = 0;
    for (const int id : ids) {
        if (id < 0) break;
        const ColorWindow& w = windows_[static_cast<std::size_t>(id)];
        const float dx = static_cast<float>(x - w.center.x),
                    dy = static_cast<float>(y - w.center.y);
        const float weight = 1 / (std::sqrt(dx * dx + dy * dy) + 1);
        p += weight * inside_probability(w, color);
        s += weight * w.separability;
        total += weight;
    }
    return total > 0 ? ColorProbability{p / total, s / total} : ColorProbability{};
}

}  // namespace weft

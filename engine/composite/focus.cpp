#include "engine/composite/focus.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/blur_inside.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr float kKnownBlur = 1.0f;       // px
constexpr float kLeastGradient = 0.03f;  // of the display range per px: below, it may be grain
constexpr float kStrongShare = 0.85f;    // quantile of gradients from which edges are strong
constexpr float kMiddle = 0.5f;          // quantile of the edges' blur
constexpr float kOfMeasuring = 0.66f;    // px²: central differences, and edges between pixels
constexpr std::size_t kFewestEdges = 60;
constexpr std::size_t kFewestOfPlace = 12;
constexpr float kSharpest = 0.3f, kMostBlurred = 6.0f;
constexpr float kAlike = 1.1f;

// Lightness as an eye weighs it, nearly: the square root.
ImageF1 lightness(ViewF3 linear) {
    ImageF1 out(linear.size());
    parallel_rows(linear.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < linear.width(); ++x) {
                const float* p = linear.pixel(x, y);
                const float v = 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
                out.row(y)[x] = v > 0 ? std::sqrt(std::min(v, 1.0f)) : 0.0f;  // NaN: 0
            }
        }
    });
    return out;
}

ImageF1 blurred(const ImageF1& plane, float sigma) {
    const std::vector<float> kernel = gaussian_kernel(sigma);
    const int r = static_cast<int>(kernel.size() / 2);
    ImageF1 rows(plane.size()), out(plane.size());
    parallel_rows(plane.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < plane.width(); ++x) {
                float sum = 0;
                for (int k = -r; k <= r; ++k)
                    sum += kernel[static_cast<std::size_t>(k + r)] *
                           plane.row(y)[std::clamp(x + k, 0, plane.width() - 1)];
                rows.row(y)[x] = sum;
            }
        }
    });
    parallel_rows(plane.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int k = -r; k <= r; ++k) {
                const float w = kernel[static_cast<std::size_t>(k + r)];
                const float* from = rows.row(std::clamp(y + k, 0, plane.height() - 1));
                for (int x = 0; x < plane.width(); ++x)
                    out.row(y)[x] += w * from[x];
            }
        }
    });
    return out;
}

struct Gradient {
    float x, y;
    [[nodiscard]] float length() const { return std::sqrt(x * x + y * y); }
};

Gradient gradient(const ImageF1& plane, int x, int y) {
    return {0.5f * (plane.row(y)[x + 1] - plane.row(y)[x - 1]),
            0.5f * (plane.row(y + 1)[x] - plane.row(y - 1)[x])};
}

bool deep_inside(ViewU8x1 matte, int x, int y) {
    constexpr int kRim = 3;
    return matte.row(y)[x] == 255 && matte.row(y - kRim)[x] == 255 &&
           matte.row(y + kRim)[x] == 255 && matte.row(y)[x - kRim] == 255 &&
           matte.row(y)[x + kRim] == 255;
}

// Gradients deep inside the matte; 0 elsewhere.
ImageF1 gradient_lengths(const ImageF1& sharp, ViewU8x1 matte) {
    const int w = sharp.width(), h = sharp.height();
    ImageF1 length(sharp.size());
    parallel_rows(h, 16, [&](int y0, int y1) {
        for (int y = std::max(4, y0); y < std::min(h - 4, y1); ++y) {
            for (int x = 4; x < w - 4; ++x)
                length.row(y)[x] = deep_inside(matte, x, y) ? gradient(sharp, x, y).length() : 0.0f;
        }
    });
    return length;
}

std::vector<EdgeBlur> edges_of(const ImageF1& sharp, const ImageF1& length, float least) {
    const ImageF1 soft = blurred(sharp, kKnownBlur);
    const int w = sharp.width(), h = sharp.height();
    std::vector<EdgeBlur> edges;
    for (int y = 4; y < h - 4; ++y) {
        for (int x = 4; x < w - 4; ++x) {
            const float here = length.row(y)[x];
            if (here < least) continue;
            // Only where the gradient is greatest across the edge: the edge's middle.
            const Gradient g = gradient(sharp, x, y);
            const int u = std::abs(g.x) > 0.4f * std::abs(g.y) ? (g.x > 0 ? 1 : -1) : 0;
            const int v = std::abs(g.y) > 0.4f * std::abs(g.x) ? (g.y > 0 ? 1 : -1) : 0;
            if (gradient(sharp, x + u, y + v).length() > here ||
                gradient(sharp, x - u, y - v).length() > here)
                continue;
            const float ratio = here / std::max(1e-6f, gradient(soft, x, y).length());
            const float variance = kKnownBlur * kKnownBlur / (ratio * ratio - 1.0f);
            const float blur =
                ratio > 1.0138f ? std::sqrt(std::max(0.0f, variance - kOfMeasuring)) : kMostBlurred;
            edges.push_back({x, y, here, blur});
        }
    }
    return edges;
}

// The median of the blurs.
float median_of(const std::vector<EdgeBlur>& edges) {
    std::vector<float> blurs;
    blurs.reserve(edges.size());
    for (const EdgeBlur& e : edges)
        blurs.push_back(e.blur_px);
    const auto at =
        blurs.begin() + static_cast<std::ptrdiff_t>(kMiddle * static_cast<float>(blurs.size() - 1));
    std::nth_element(blurs.begin(), at, blurs.end());
    return std::clamp(*at, kSharpest, kMostBlurred);
}

}  // namespace

std::vector<EdgeBlur> edge_blurs(ViewF3 linear, ViewU8x1 matte, float least_gradient) {
    const ImageF1 sharp = lightness(linear);
    if (sharp.width() < 9 || sharp.height() < 9) return {};
    return edges_of(sharp, gradient_lengths(sharp, matte), least_gradient);
}

float sharper_blur_px(std::vector<EdgeBlur> edges) {
    if (edges.size() < kFewestOfPlace) return 0;
    const auto third = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 3);
    std::nth_element(edges.begin(), third, edges.end(), [](const EdgeBlur& a, const EdgeBlur& b) {
        if (a.strength != b.strength) return a.strength > b.strength;
        return a.y != b.y ? a.y < b.y : a.x < b.x;
    });
    edges.erase(third, edges.end());
    return median_of(edges);
}

float edge_blur_px(ViewF3 linear, ViewU8x1 matte) {
    const ImageF1 sharp = lightness(linear);
    if (sharp.width() < 9 || sharp.height() < 9) return 0;
    const ImageF1 length = gradient_lengths(sharp, matte);
    std::vector<float> lengths;
    for (int y = 0; y < length.height(); ++y) {
        for (int x = 0; x < length.width(); ++x) {
            if (length.row(y)[x] > 0) lengths.push_back(length.row(y)[x]);
        }
    }
    if (lengths.size() < kFewestEdges) return 0;
    const auto strong =
        lengths.begin() +
        static_cast<std::ptrdiff_t>(kStrongShare * static_cast<float>(lengths.size() - 1));
    std::nth_element(lengths.begin(), strong, lengths.end());
    const std::vector<EdgeBlur> edges = edges_of(sharp, length, std::max(kLeastGradient, *strong));
    return edges.size() < kFewestEdges ? 0.0f : median_of(edges);
}

float blur_between(float from_px, float to_px) {
    if (!(from_px > 0) || !(to_px > kAlike * from_px)) return 0;
    return std::sqrt(to_px * to_px - from_px * from_px);
}

}  // namespace weft

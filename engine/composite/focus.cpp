#include "engine/composite/focus.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "engine/core/blur_inside.h"
#include "engine/core/luma.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr float kLeastGradient = 0.03f;  // of the display range per px; below this it may be grain
constexpr float kStrongShare = 0.7f;     // quantile of gradients from which edges are strong
// Quantiles of the edges' blur. A lens leaves no edge sharper than its own blur, while paint and
// shade have edges that are softer; a place has too few edges for so low a quantile.
constexpr float kSharpestEdges = 0.1f, kSharpEdges = 0.15f, kSharpEdgesOfPlace = 0.25f;
// The median blur over that of the sharpest tenth: of edges under one lens, and of penumbras.
constexpr float kAsOneLens = 1.8f, kUnalike = 2.6f;
constexpr float kAlongEdge = 8;
constexpr float kEdgeEnds = 0.15f;  // of its slope, where an edge ends
constexpr int kFarthest = 12;       // steps
constexpr int kMostRows = 270;
constexpr std::size_t kFewestEdges = 60, kManyEdges = 180;
constexpr std::size_t kFewestOfPlace = 12;
constexpr float kNoBlur = 0.3f;                 // px; a smaller blur widens no step
constexpr float kAlike = 1.1f, kSofter = 1.4f;  // ratios of blurs
constexpr float kMostAgain = 1.2f;              // times the first trial

// Approximate perceived lightness: the square root.
ImageF1 lightness(ViewF3 linear) {
    ImageF1 out(linear.size());
    parallel_rows(linear.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < linear.width(); ++x) {
                const float* p = linear.pixel(x, y);
                const float v = luma_709(p);
                out.row(y)[x] = v > 0 ? std::sqrt(std::min(v, 1.0f)) : 0.0f;  // NaN: 0
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

// The bisection of blurs by width, as a tree whose node n has the children 2n and 2n + 1: at each
// node the width that an ideal step has under the blur in the middle. A step's width is its height
// over its central difference, both on the pixel grid: 2 / erf(1 / (√2 σ)).
constexpr int kHalvings = 16;

void fill_widths(std::vector<float>& widths, std::size_t node, float low, float high) {
    if (node >= widths.size()) return;
    constexpr float kRootTwo = 1.41421356f;
    const float middle = 0.5f * (low + high);
    widths[node] = 2.0f / std::erf(1.0f / (middle * kRootTwo));
    fill_widths(widths, 2 * node, low, middle);
    fill_widths(widths, 2 * node + 1, middle, high);
}

const std::vector<float>& widths_by_blur() {
    static const std::vector<float> widths = [] {
        std::vector<float> out(std::size_t{1} << kHalvings);
        fill_widths(out, 1, kNoBlur, kSoftestEdge_px);
        return out;
    }();
    return widths;
}

// The deviation of the Gaussian that makes an ideal step as wide as `width`.
float blur_of_width(float width) {
    const std::vector<float>& widths = widths_by_blur();
    float low = kNoBlur, high = kSoftestEdge_px;  // the width grows with the blur
    std::size_t node = 1;
    for (int i = 0; i < kHalvings; ++i) {
        const float middle = 0.5f * (low + high);
        const bool wider = widths[node] < width;
        (wider ? low : high) = middle;
        node = 2 * node + (wider ? 1 : 0);
    }
    return 0.5f * (low + high);
}

// How far an edge extends to either side of a pixel, in steps across it, and its width in such
// steps.
struct EdgeExtent {
    int up = 0, down = 0;
    float width = 0;  // 0: no edge
};

// It extends while it rises by more than kEdgeEnds of its slope, within the matte. (u, v): the
// direction across it.
EdgeExtent edge_extent(const ImageF1& sharp, const ImageF1& length, int x, int y, int u, int v) {
    const auto at = [&](int k) { return sharp.row(y + k * v)[x + k * u]; };
    const auto known = [&](int k) {
        const int p = x + k * u, q = y + k * v;
        return p >= 0 && q >= 0 && p < sharp.width() && q < sharp.height() && length.row(q)[p] > 0;
    };
    const float slope = 0.5f * (at(1) - at(-1));
    if (!(slope > 0)) return {};
    int up = 0, down = 0;
    while (up < kFarthest && known(up + 1) && at(up + 1) - at(up) > kEdgeEnds * slope)
        ++up;
    while (down < kFarthest && known(-down - 1) && at(-down) - at(-down - 1) > kEdgeEnds * slope)
        ++down;
    return {up, down, (at(up) - at(-down)) / slope};
}

void edges_in_row(const ImageF1& sharp, const ImageF1& length, float least, int y,
                  std::vector<EdgeBlur>& edges) {
    const auto length_at = [&](int p, int q) {
        const float known = length.row(q)[p];
        return known > 0 ? known : gradient(sharp, p, q).length();
    };
    for (int x = 4; x < sharp.width() - 4; ++x) {
        const float here = length.row(y)[x];
        if (here < least) continue;
        // Only where the gradient is greatest across the edge, which is the edge's middle.
        const Gradient g = gradient(sharp, x, y);
        const int u = std::abs(g.x) > 0.4f * std::abs(g.y) ? (g.x > 0 ? 1 : -1) : 0;
        const int v = std::abs(g.y) > 0.4f * std::abs(g.x) ? (g.y > 0 ? 1 : -1) : 0;
        if (length_at(x + u, y + v) > here || length_at(x - u, y - v) > here) continue;
        const EdgeExtent extent = edge_extent(sharp, length, x, y, u, v);
        if (!(extent.width > 0)) continue;
        const float step_px = u != 0 && v != 0 ? 1.41421356f : 1.0f;
        edges.push_back({x,
                         y,
                         here,
                         std::max(kSharpestEdge_px, step_px * blur_of_width(extent.width)),
                         {x - extent.down * u, y - extent.down * v},
                         {x + extent.up * u, y + extent.up * v}});
    }
}

// Every how many rows edges are looked for: a delivery at twice the size has no more to tell.
int row_step(int height) {
    return 1 + (height - 1) / kMostRows;
}

// In the order of the rows.
std::vector<EdgeBlur> edges_of(const ImageF1& sharp, const ImageF1& length, float least) {
    const int h = sharp.height(), step = row_step(h);
    std::vector<std::vector<EdgeBlur>> rows(static_cast<std::size_t>(h));
    parallel_rows(h, 16, [&](int y0, int y1) {
        for (int y = std::max(4, y0); y < std::min(h - 4, y1); ++y) {
            if (y % step == 0)
                edges_in_row(sharp, length, least, y, rows[static_cast<std::size_t>(y)]);
        }
    });
    std::vector<EdgeBlur> edges;
    for (const std::vector<EdgeBlur>& row : rows)
        edges.insert(edges.end(), row.begin(), row.end());
    return edges;
}

// A quantile of their blurs.
float blur_at(float quantile, const std::vector<EdgeBlur>& edges) {
    std::vector<float> blurs;
    blurs.reserve(edges.size());
    for (const EdgeBlur& e : edges)
        blurs.push_back(e.blur_px);
    const auto at = blurs.begin() +
                    static_cast<std::ptrdiff_t>(quantile * static_cast<float>(blurs.size() - 1));
    std::nth_element(blurs.begin(), at, blurs.end());
    return std::clamp(*at, kSharpestEdge_px, kSoftestEdge_px);
}

std::vector<EdgeBlur> strong_edges(const PictureEdges& picture) {
    std::vector<EdgeBlur> strong;
    if (picture.strong > 0) {
        std::copy_if(picture.edges.begin(), picture.edges.end(), std::back_inserter(strong),
                     [&](const EdgeBlur& edge) { return edge.strength >= picture.strong; });
    }
    return strong;
}

// The gradient from which edges count as strong; 0 if there are too few to tell.
float strong_gradient(const ImageF1& length) {
    std::vector<float> lengths;
    for (int y = 0; y < length.height(); y += row_step(length.height())) {
        const float* row = length.row(y);
        std::copy_if(row, row + length.width(), std::back_inserter(lengths),
                     [](float v) { return v > 0; });
    }
    if (lengths.size() < kFewestEdges) return 0;
    const auto strong =
        lengths.begin() +
        static_cast<std::ptrdiff_t>(kStrongShare * static_cast<float>(lengths.size() - 1));
    std::nth_element(lengths.begin(), strong, lengths.end());
    return std::max(kLeastGradient, *strong);
}

}  // namespace

std::vector<EdgeBlur> edge_blurs(ViewF3 linear, ViewU8x1 matte, float least_gradient) {
    const ImageF1 sharp = lightness(linear);
    if (sharp.width() < 9 || sharp.height() < 9) return {};
    return edges_of(sharp, gradient_lengths(sharp, matte), least_gradient);
}

float sharper_blur_px(std::vector<EdgeBlur> edges) {
    if (edges.size() < kFewestOfPlace) return 0;
    const auto rest = edges.begin() + static_cast<std::ptrdiff_t>(2 * edges.size() / 3);
    std::nth_element(edges.begin(), rest, edges.end(), [](const EdgeBlur& a, const EdgeBlur& b) {
        if (a.strength != b.strength) return a.strength > b.strength;
        return a.y != b.y ? a.y < b.y : a.x < b.x;
    });
    edges.erase(rest, edges.end());
    return blur_at(kSharpEdgesOfPlace, edges);
}

PictureEdges picture_edges(ViewF3 linear, ViewU8x1 matte, float least_gradient) {
    const ImageF1 sharp = lightness(linear);
    if (sharp.width() < 9 || sharp.height() < 9) return {};
    const ImageF1 length = gradient_lengths(sharp, matte);
    const float strong = strong_gradient(length);
    const float least = strong > 0 ? std::min(least_gradient, strong) : least_gradient;
    return {edges_of(sharp, length, least), strong};
}

float strong_blur_px(const PictureEdges& picture) {
    const std::vector<EdgeBlur> strong = strong_edges(picture);
    return strong.size() < kFewestEdges ? 0.0f : blur_at(kSharpEdges, strong);
}

float strong_blur_error_px(const PictureEdges& picture) {
    const std::vector<EdgeBlur> strong = strong_edges(picture);
    if (strong.size() < kFewestEdges) return 0;
    // The ranks one deviation to either side of the quantile. Neighbours along an edge say the same
    // thing: kAlongEdge of them count as one.
    const auto n = static_cast<float>(strong.size()) / kAlongEdge;
    const float ranks = std::sqrt(kSharpEdges * (1 - kSharpEdges) / n);
    const float low = blur_at(std::max(0.0f, kSharpEdges - ranks), strong);
    const float high = blur_at(std::min(1.0f, kSharpEdges + ranks), strong);
    return 0.5f * (high - low);
}

float blur_confidence(const PictureEdges& picture) {
    const std::vector<EdgeBlur> strong = strong_edges(picture);
    if (strong.size() < kFewestEdges) return 0;
    const auto ramp = [](float at_0, float at_1, float v) {
        return std::clamp((v - at_0) / (at_1 - at_0), 0.0f, 1.0f);
    };
    const float spread = blur_at(0.5f, strong) / blur_at(kSharpestEdges, strong);
    return ramp(static_cast<float>(kFewestEdges), static_cast<float>(kManyEdges),
                static_cast<float>(strong.size())) *
           ramp(kUnalike, kAsOneLens, spread);
}

float edge_blur_px(ViewF3 linear, ViewU8x1 matte) {
    constexpr float kAny = std::numeric_limits<float>::infinity();
    return strong_blur_px(picture_edges(linear, matte, kAny));
}

float blur_between(float from_px, float to_px) {
    if (!(from_px > 0) || !(to_px > kAlike * from_px)) return 0;
    // Sets in gradually, so that it does not come and go from frame to frame.
    const float share = std::min(1.0f, (to_px / from_px - kAlike) / (kSofter - kAlike));
    return share * std::sqrt(to_px * to_px - from_px * from_px);
}

float blur_to_match(ViewF3 texture, ViewU8x1 matte, float own_px, float plate_px) {
    const float first = blur_between(own_px, plate_px);
    if (!(first > 0)) return 0;
    ImageF3 tried(texture.size());
    for (int y = 0; y < texture.height(); ++y)
        std::copy(texture.row(y), texture.row(y) + 3 * texture.width(), tried.row(y));
    blur_inside(tried, matte, first);
    const float got_px = edge_blur_px(tried, matte);
    if (!(got_px > 0)) return first;
    const float variance = 2 * first * first + own_px * own_px - got_px * got_px;
    return std::clamp(std::sqrt(std::max(0.0f, variance)), first / kMostAgain, first * kMostAgain);
}

}  // namespace weft

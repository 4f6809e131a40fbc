#include "engine/motion/flat_motion.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/motion/plane_fit.h"

namespace weft {
namespace {

// What is far off the first plane, such as a piece that found itself elsewhere, does not draw at
// the second one: out at the edge of a surface even small weights do.
glm::dmat3 fit_trimmed(std::vector<PlacePair> pairs) {
    constexpr float kUsual = 3, kLeast_px = 1;
    const glm::dmat3 first = fit_plane(pairs);
    if (pairs.empty()) return first;
    std::vector<float> misses;
    misses.reserve(pairs.size());
    for (const PlacePair& pair : pairs)
        misses.push_back(glm::length(mapped(first, pair.from) - pair.to));
    std::vector<float> sorted = misses;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const float most = std::max(kLeast_px, kUsual * *middle);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        if (misses[k] <= most) pairs[kept++] = pairs[k];
    }
    pairs.resize(kept);
    return fit_plane(pairs);
}

// Calls visit(p) for at most some thousand places on a grid over what a picture of weights knows.
template <class Visit>
void each_known(ViewU8x1 weights, std::uint8_t least, const Visit& visit) {
    constexpr std::int64_t kMostPairs = 1000;
    std::int64_t known = 0;
    for (int y = 0; y < weights.height(); ++y) {
        const std::uint8_t* row = weights.row(y);
        known +=
            std::count_if(row, row + weights.width(), [&](std::uint8_t w) { return w >= least; });
    }
    int stride = 1;
    while (known / (std::int64_t{stride} * stride) > kMostPairs)
        ++stride;
    for (int y = stride / 2; y < weights.height(); y += stride)
        for (int x = stride / 2; x < weights.width(); x += stride)
            if (weights.at(x, y) >= least) visit(x, y);
}

Vec2 centre(int x, int y) {
    return {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
}

// The plane that explains most of the pairs.
LatticeField field_of_plane(const std::vector<PlacePair>& pairs, Size size, int spacing_px) {
    const glm::dmat3 plane = fit_trimmed(pairs);
    std::vector<double> depths;
    depths.reserve(pairs.size());
    for (const PlacePair& pair : pairs)
        depths.push_back((plane * glm::dvec3(pair.from, 1)).z);
    const double nearest = nearest_depth(std::move(depths));
    LatticeField out(size, spacing_px);
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i) {
            const Vec2 p = out.node_position(i, j);
            const glm::dvec3 q = plane * glm::dvec3(p, 1);
            out.set_node(i, j, Vec2(glm::dvec2(q) / std::max(q.z, nearest)) - p);
        }
    }
    return out;
}

}  // namespace

LatticeField fit_flat_motion(ViewF2 flow, ViewU8x1 weights, int spacing_px) {
    std::vector<PlacePair> pairs;
    each_known(weights, 1, [&](int x, int y) {
        const Vec2 p = centre(x, y);
        const float* d = flow.pixel(x, y);
        pairs.push_back({p, p + Vec2(d[0], d[1])});
    });
    return field_of_plane(pairs, flow.size(), spacing_px);
}

LatticeField flattened(const LatticeField& field, ViewU8x1 visible) {
    constexpr std::uint8_t kHalf = 128;
    std::vector<PlacePair> pairs;
    each_known(visible, kHalf, [&](int x, int y) {
        const Vec2 p = centre(x, y);
        pairs.push_back({p, p + field.at(p)});
    });
    return field_of_plane(pairs, field.full_size(), field.spacing());
}

}  // namespace weft

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

}  // namespace

LatticeField fit_flat_motion(ViewF2 flow, ViewU8x1 weights, int spacing_px) {
    constexpr std::int64_t kMostPairs = 1000;
    std::int64_t known = 0;
    for (int y = 0; y < weights.height(); ++y) {
        const std::uint8_t* row = weights.row(y);
        known += weights.width() - std::count(row, row + weights.width(), 0);
    }
    int stride = 1;
    while (known / (std::int64_t{stride} * stride) > kMostPairs)
        ++stride;
    std::vector<PlacePair> pairs;
    for (int y = stride / 2; y < weights.height(); y += stride) {
        for (int x = stride / 2; x < weights.width(); x += stride) {
            if (weights.at(x, y) == 0) continue;
            const Vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            const float* d = flow.pixel(x, y);
            pairs.push_back({p, p + Vec2(d[0], d[1])});
        }
    }
    const glm::dmat3 plane = fit_trimmed(std::move(pairs));
    LatticeField out(flow.size(), spacing_px);
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i) {
            const Vec2 p = out.node_position(i, j);
            out.set_node(i, j, mapped(plane, p) - p);
        }
    }
    return out;
}

}  // namespace weft

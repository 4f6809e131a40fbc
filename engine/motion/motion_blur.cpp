#include "engine/motion/motion_blur.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/core/parallel.h"

namespace weft {
namespace {

Recti box_of(ViewU8x1 visible) {
    Recti box{visible.width(), visible.height(), 0, 0};
    for (int y = 0; y < visible.height(); ++y) {
        const std::uint8_t* row = visible.row(y);
        for (int x = 0; x < visible.width(); ++x) {
            if (row[x] < 128) continue;
            box.x0 = std::min(box.x0, x);
            box.x1 = std::max(box.x1, x + 1);
            box.y0 = std::min(box.y0, y);
            box.y1 = y + 1;
        }
    }
    return box;
}

// Bilinear; `grid` inside of the luma by half a pixel, counted from the first pixel's centre.
float between_pixels(ViewU8x1 luma, Vec2 grid) {
    const int x = std::min(static_cast<int>(grid.x), luma.width() - 2);
    const int y = std::min(static_cast<int>(grid.y), luma.height() - 2);
    const float fx = grid.x - static_cast<float>(x), fy = grid.y - static_cast<float>(y);
    const std::uint8_t *upper = luma.row(y) + x, *lower = luma.row(y + 1) + x;
    const auto mixed = [fx](const std::uint8_t* two) {
        return static_cast<float>(two[0]) + fx * static_cast<float>(two[1] - two[0]);
    };
    const float above = mixed(upper);
    return above + fy * (mixed(lower) - above);
}

// The mean along the way through a pixel; negative if the way leaves the surface.
float mean_along(ViewU8x1 luma, ViewU8x1 visible, Vec2 pixel, Vec2 way) {
    constexpr float kLongest_px = 400;
    const float length = glm::length(way);
    if (!(length < kLongest_px)) return -1;
    // An odd number of samples, in the middles of as many parts of the way.
    const int halves = static_cast<int>(std::ceil(0.5f * length));
    const Vec2 step = way / static_cast<float>(2 * halves + 1);
    const Vec2 most(static_cast<float>(luma.width() - 1), static_cast<float>(luma.height() - 1));
    float sum = 0;
    for (int k = -halves; k <= halves; ++k) {
        const Vec2 at = pixel + static_cast<float>(k) * step;
        if (!(at.x >= 0 && at.y >= 0 && at.x <= most.x && at.y <= most.y)) return -1;
        const Vec2 nearest = at + 0.5f;
        if (visible.at(static_cast<int>(nearest.x), static_cast<int>(nearest.y)) < 128) return -1;
        sum += between_pixels(luma, at);
    }
    return sum / static_cast<float>(2 * halves + 1);
}

}  // namespace

ExposedFrame exposed_along(ViewU8x1 luma, ViewU8x1 visible, const LatticeField& motion) {
    ExposedFrame out{Matte(luma.size()), Matte(luma.size())};
    for (int y = 0; y < luma.height(); ++y) {
        std::copy_n(luma.row(y), luma.width(), out.luma.row(y));
        std::fill_n(out.visible.row(y), luma.width(), std::uint8_t{0});
    }
    const Recti box = box_of(visible);
    if (box.empty() || luma.width() < 2 || luma.height() < 2) return out;
    const ImageF2 ways = motion.dense(box);
    parallel_for(static_cast<std::size_t>(box.height()), [&](std::size_t row) {
        const int y = box.y0 + static_cast<int>(row);
        for (int x = box.x0; x < box.x1; ++x) {
            if (visible.at(x, y) < 128) continue;
            const float* way = ways.pixel(x - box.x0, static_cast<int>(row));
            const Vec2 pixel(static_cast<float>(x), static_cast<float>(y));
            const float mean = mean_along(luma, visible, pixel, {way[0], way[1]});
            if (mean < 0) continue;
            out.luma.at(x, y) = static_cast<std::uint8_t>(std::min(255.0f, mean + 0.5f));
            out.visible.at(x, y) = 255;
        }
    });
    return out;
}

LatticeField motion_seen_from(const LatticeField& motion, const LatticeField& there_from_here,
                              const LatticeField& here_from_there) {
    LatticeField out(there_from_here.full_size(), there_from_here.spacing());
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i) {
            const Vec2 here = out.node_position(i, j), there = here + there_from_here.node(i, j);
            const Vec2 way = motion.at(there);
            out.set_node(i, j, way + here_from_there.at(there + way) - here_from_there.at(there));
        }
    }
    return out;
}

}  // namespace weft

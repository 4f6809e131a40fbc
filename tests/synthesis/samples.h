#pragma once
// Samples made for tests, and checks that every plane must pass.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>

#include "engine/core/rng.h"
#include "engine/synthesis/texture_plane.h"

namespace weft::test {

/// Smooth noise: random blobs of a few pixels, like a fine natural texture.
inline ImageU8x3 blob_sample(int w, int h, std::uint64_t seed) {
    Rng rng(seed);
    Image<float, 3> rough(w, h);
    for (int i = 0; i < w * h * 3; ++i)
        rough.data()[i] = static_cast<float>(rng.below(256));
    ImageU8x3 out(w, h);
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            for (int c = 0; c < 3; ++c) {
                float sum = 0;
                int n = 0;
                for (int dy = -2; dy <= 2; ++dy) {
                    for (int dx = -2; dx <= 2; ++dx) {
                        if (x + dx < 0 || y + dy < 0 || x + dx >= w || y + dy >= h) continue;
                        sum += rough.at(x + dx, y + dy, c);
                        ++n;
                    }
                }
                const float v = 128 + 3 * (sum / static_cast<float>(n) - 128);
                out.at(x, y, c) = static_cast<std::uint8_t>(std::fmin(255.0f, std::fmax(0.0f, v)));
            }
        }
    }
    return out;
}

/// A wall of bricks of `period_x` × `period_y` px, every other course shifted by half a brick.
inline ImageU8x3 brick_sample(int w, int h, int period_x, int period_y) {
    ImageU8x3 out(w, h);
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const int course = y / period_y;
            const int bx = (x + course % 2 * (period_x / 2)) % period_x, by = y % period_y;
            const bool mortar = bx < 3 || by < 3;
            out.at(x, y, 0) = static_cast<std::uint8_t>(mortar ? 210 : 150 + 2 * by);
            out.at(x, y, 1) = static_cast<std::uint8_t>(mortar ? 205 : 60 + bx);
            out.at(x, y, 2) = static_cast<std::uint8_t>(mortar ? 200 : 50);
        }
    }
    return out;
}

inline PlaneOptions sized(int w, int h) {
    PlaneOptions o;
    o.size = {w, h};
    return o;
}

inline TexturePlane grow(ViewU8x3 sample, const PlaneOptions& options) {
    auto plane = grow_plane(sample, options);
    EXPECT_TRUE(plane) << (plane ? "" : plane.error().text());
    return plane ? std::move(*plane) : TexturePlane{};
}

/// Every texel shows the sample pixel that the source map names, and the seams add up to what the
/// statistics say, counted here by the definition.
inline void expect_sound(ViewU8x3 sample, const TexturePlane& plane, const PlaneOptions& options) {
    const int w = options.size.width, h = options.size.height;
    ASSERT_EQ(plane.pixels.size(), options.size);
    ASSERT_EQ(plane.source.size(), options.size);
    int wrong = 0;
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const int sx = plane.source.at(x, y, 0), sy = plane.source.at(x, y, 1);
            if (sx < 0 || sy < 0 || sx >= sample.width() || sy >= sample.height()) {
                ++wrong;
                continue;
            }
            for (int c = 0; c < 3 && options.feather_px == 0; ++c) {
                wrong += plane.pixels.at(x, y, c) != sample.at(sx, sy, c);
            }
        }
    }
    ASSERT_EQ(wrong, 0);

    double energy = 0;
    std::int64_t length = 0;
    const auto colour = [&](int sx, int sy, int c) {
        return static_cast<double>(sample.at(std::min(std::max(sx, 0), sample.width() - 1),
                                             std::min(std::max(sy, 0), sample.height() - 1), c));
    };
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            for (int axis = 0; axis < 2; ++axis) {
                const int dx = axis == 0, dy = axis == 1;
                if (!options.tileable && (x + dx >= w || y + dy >= h)) continue;
                if ((axis == 0 ? w : h) == 1) continue;  // A texel is not its own neighbour.
                const auto* p = plane.source.pixel(x, y);
                const auto* q = plane.source.pixel((x + dx) % w, (y + dy) % h);
                if (q[0] == p[0] + dx && q[1] == p[1] + dy) continue;
                ++length;
                for (int end = 0; end < 2; ++end) {
                    double sum = 0;
                    for (int c = 0; c < 3; ++c) {
                        const double a = colour(p[0] + end * dx, p[1] + end * dy, c);
                        const double b = colour(q[0] + (end - 1) * dx, q[1] + (end - 1) * dy, c);
                        sum += (a - b) * (a - b);
                    }
                    energy += std::sqrt(sum);
                }
            }
        }
    }
    EXPECT_EQ(plane.stats.seam_length_px, length);
    EXPECT_NEAR(plane.stats.seam_energy, energy, 1e-6 * (energy + 1));
    EXPECT_NEAR(plane.stats.seam_energy_per_area, energy / (static_cast<double>(w) * h),
                1e-6 * (energy + 1));
}

}  // namespace weft::test

#pragma once
// A textured disc that moves over a textured background, with its true motion.

#include <cmath>

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/core/rng.h"

namespace weft::test {

struct DiscScene {
    Size size{160, 120};
    float radius_px = 26;
    Vec2 start{50, 60};
    Vec2 step{2.3f, 0.4f};  ///< Pixels a frame.

    [[nodiscard]] Vec2 center(int t) const { return start + static_cast<float>(t) * step; }

    /// Coverage of the disc, 0–255, soft over one pixel.
    [[nodiscard]] Matte matte(int t) const {
        Matte m(size);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x)
                m.at(x, y) = coverage_u8(x, y, t);
        }
        return m;
    }

    [[nodiscard]] ImageU8x3 frame(int t, std::uint64_t noise_seed = 0) const {
        ImageU8x3 f(size);
        Rng rng(7, noise_seed, static_cast<std::uint64_t>(t));
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const float a = static_cast<float>(coverage_u8(x, y, t)) / 255;
                const Vec2 on_disc = Vec2(x, y) - center(t);
                const Vec3 disc(150 + wave(on_disc, 0.9f), 90 + wave(on_disc, 1.3f), 60);
                const Vec3 ground(95 + wave(Vec2(x, y), 1.1f), 120 + wave(Vec2(y, x), 0.7f), 110);
                const Vec3 c = a * disc + (1 - a) * ground;
                for (int i = 0; i < 3; ++i) {
                    const auto noise = static_cast<float>(rng.uniform() * 6 - 3);
                    f.at(x, y, i) = static_cast<std::uint8_t>(c[i] + noise + 0.5f);
                }
            }
        }
        return f;
    }

    /// True motion from frame t to frame t − 1; what the disc has just uncovered is invalid.
    [[nodiscard]] FlowField prev_from_cur(int t) const {
        FlowField f(size);
        const Matte now = matte(t), before = matte(t - 1);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const bool on_disc = now.at(x, y) >= 128;
                f.d.at(x, y, 0) = on_disc ? -step.x : 0;
                f.d.at(x, y, 1) = on_disc ? -step.y : 0;
                if (!on_disc && before.at(x, y) >= 128) f.valid.at(x, y) = 0;
            }
        }
        return f;
    }

  private:
    [[nodiscard]] std::uint8_t coverage_u8(int x, int y, int t) const {
        const float d = radius_px - glm::length(Vec2(x, y) - center(t));
        return static_cast<std::uint8_t>(std::min(std::max(d + 0.5f, 0.0f), 1.0f) * 255 + 0.5f);
    }
    static float wave(Vec2 p, float k) {
        return 22 * std::sin(k * p.x + 0.4f * p.y) * std::sin(0.5f * p.x - k * p.y);
    }
};

/// Intersection over union of what is at least half covered.
inline double overlap(ViewU8x1 a, ViewU8x1 b) {
    int both = 0, either = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            const bool p = a.at(x, y) >= 128, q = b.at(x, y) >= 128;
            both += p && q ? 1 : 0;
            either += p || q ? 1 : 0;
        }
    }
    return either > 0 ? static_cast<double>(both) / either : 1.0;
}

}  // namespace weft::test

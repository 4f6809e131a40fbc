#pragma once
// Pictures and motion with known answers.

#include <cmath>
#include <cstdint>
#include <numbers>

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/core/rng.h"
#include "engine/metrics/ideal.h"

namespace weft::synthetic {

inline constexpr double kPi = std::numbers::pi;

/// Mean 128 levels, ± amplitude, waves along both axes, seen from (dx, dy) further left and up.
inline ImageF1 waves(Size s, double period_px, double amplitude, double dx = 0, double dy = 0) {
    ImageF1 out(s);
    for (int y = 0; y < s.height; ++y) {
        for (int x = 0; x < s.width; ++x) {
            const double a = std::sin(2 * kPi * (x + 0.5 - dx) / period_px);
            const double b = std::sin(2 * kPi * (y + 0.5 - dy) / period_px);
            out.at(x, y) = static_cast<float>(128 + amplitude * 0.5 * (a + b));
        }
    }
    return out;
}

/// A grey plane that repeats: random blobs of a few texels, contrast over the whole range.
inline ImageU8x3 blobs(int side, std::uint64_t seed) {
    Image<float, 1> noise(side, side);
    Rng rng(seed);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x)
            noise.at(x, y) = static_cast<float>(rng.uniform());
    }
    ImageU8x3 out(side, side);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            float sum = 0;
            for (int j = 0; j < 3; ++j) {
                for (int i = 0; i < 3; ++i)
                    sum += noise.at((x + i) % side, (y + j) % side);
            }
            const float v = std::fmin(255.0f, std::fmax(0.0f, 128 + 400 * (sum / 9 - 0.5f)));
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = static_cast<std::uint8_t>(v);
        }
    }
    return out;
}

inline FlowField constant_motion(Size s, float dx, float dy) {
    FlowField f(s);
    for (int y = 0; y < s.height; ++y) {
        for (int x = 0; x < s.width; ++x) {
            f.d.at(x, y, 0) = dx;
            f.d.at(x, y, 1) = dy;
        }
    }
    return f;
}

/// The size of slid_texture().
inline constexpr Size kSlidSize{200, 160};

/// What a textured plane shows when it has slid by (dx, dy).
inline ImageF1 slid_texture(float dx, float dy, std::uint64_t seed = 5) {
    return IdealTexture(blobs(128, seed)).render_luma(constant_motion(kSlidSize, -dx, -dy), {});
}

inline Matte rectangle(Size s, Recti r) {
    Matte m(s);
    for (int y = r.y0; y < r.y1; ++y) {
        for (int x = r.x0; x < r.x1; ++x)
            m.at(x, y) = 255;
    }
    return m;
}

inline ImageF3 grey(const ImageF1& luma_8bit) {
    ImageF3 out(luma_8bit.size());
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = luma_8bit.at(x, y) / 255.0f;
        }
    }
    return out;
}

}  // namespace weft::synthetic

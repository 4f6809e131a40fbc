#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/composite/composite.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr int kBand = 16;
constexpr float kBelowWhite = 0.045f;  // linear light that code 250 lacks
constexpr float kMostKnee = 0.9f, kLeastKnee = 0.5f;

// NaN does not count.
float highest_of(const float* p) {
    return std::fmax(std::fmax(p[0], p[1]), p[2]);
}

}  // namespace

void composite_over(ImageView<float, 3> out, ViewF3 plate, ViewF3 surface, ViewU8x1 matte,
                    ViewF3 texture) {
    parallel_rows(out.height(), kBand, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const std::uint8_t* m = matte.row(y);
            for (int x = 0; x < out.width(); ++x) {
                if (m[x] == 0) continue;
                const float* t = texture.pixel(x, y);
                float* o = out.pixel(x, y);
                const float share = static_cast<float>(m[x]) / 255.0f;
                for (int c = 0; c < 3; ++c) {
                    const float f = plate.pixel(x, y)[c];
                    if (m[x] == 255 || !std::isfinite(f)) {
                        o[c] = t[c];
                        continue;
                    }
                    const float mixed = f + share * (t[c] - surface.pixel(x, y)[c]);
                    o[c] = f >= 0 ? std::max(0.0f, mixed) : mixed;
                }
            }
        }
    });
}

long roll_off(ImageView<float, 3> rgb, ViewU8x1 matte, float knee) {
    knee = std::clamp(knee, 0.0f, 0.999f);
    const float room = 1.0f - knee;
    std::vector<long> exceeded(static_cast<std::size_t>(std::max(0, rgb.height())), 0);
    parallel_rows(rgb.height(), kBand, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const std::uint8_t* m = matte.row(y);
            for (int x = 0; x < rgb.width(); ++x) {
                float* p = rgb.pixel(x, y);
                const float highest = highest_of(p);
                if (m[x] == 0 || !(highest > knee)) continue;
                if (highest > 1.0f) ++exceeded[static_cast<std::size_t>(y)];
                // Slope 1 at the knee, 1 at infinity; one factor for the three channels keeps the
                // hue.
                const float over = (highest - knee) / room;
                const float rolled =
                    std::isfinite(over) ? knee + room * (over / (1.0f + over)) : 1.0f;
                const float share = static_cast<float>(m[x]) / 255.0f;
                for (int c = 0; c < 3; ++c) {
                    const float to = std::isfinite(p[c]) && std::isfinite(highest)
                                         ? p[c] * (rolled / highest)
                                     : p[c] > 0 ? 1.0f
                                                : 0.0f;
                    p[c] = std::isfinite(p[c]) && m[x] < 255 ? p[c] + share * (to - p[c]) : to;
                }
            }
        }
    });
    long total = 0;
    for (const long n : exceeded)
        total += n;
    return total;
}

// With u = 1 − knee, the peak p lacks u² / (p − 1 + 2 u) of white after the roll-off.
float roll_off_knee(float peak) {
    if (!(peak > 1)) return kMostKnee;
    const float room = kBelowWhite + std::sqrt(kBelowWhite * (kBelowWhite + peak - 1));
    return std::clamp(1 - room, kLeastKnee, kMostKnee);
}

}  // namespace weft

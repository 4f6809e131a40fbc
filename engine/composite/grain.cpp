#include "engine/composite/grain.h"

#include <algorithm>
#include <cmath>

#include "engine/core/luma.h"
#include "engine/core/parallel.h"
#include "engine/core/rng.h"

namespace weft {
namespace {

constexpr int kReach = GrainModel::kRadius;
constexpr int kBins = GrainModel::kBins;

// A random number of deviation 1 for a pixel and channel of the plate: the sum of four uniform ones
// is normal enough, and needs no function whose last bit may differ between machines.
float normal(std::uint64_t key, int x, int y, int channel) {
    const auto place = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) |
                       static_cast<std::uint32_t>(y);
    const std::uint64_t bits =
        mix64(mix64(key ^ mix64(place)) + static_cast<std::uint64_t>(channel));
    std::uint32_t sum = 0;
    for (int k = 0; k < 4; ++k)
        sum += static_cast<std::uint32_t>((bits >> (16 * k)) & 0xffff);
    constexpr float kMean = 4 * 32767.5f, kDeviation = 37837.2f;  // 2 · 65536 / √12
    return (static_cast<float>(sum) - kMean) / kDeviation;
}

}  // namespace

bool GrainModel::present() const {
    for (const auto& channel : deviation) {
        for (const float d : channel) {
            if (d > 0) return true;
        }
    }
    return false;
}

void add_grain(ImageView<float, 3> display, ViewU8x1 matte, Vec2i origin, const GrainModel& model,
               float strength, std::uint64_t key) {
    if (!model.present() || !(strength > 0) || display.empty()) return;
    constexpr int kSide = GrainModel::kSide;
    const auto& m = model.mix;
    const int width = display.width() + 2 * kReach;
    parallel_rows(display.height(), 16, [&](int y0, int y1) {
        ImageF3 white(width, y1 - y0 + 2 * kReach);
        for (int y = 0; y < white.height(); ++y) {
            for (int x = 0; x < width; ++x) {
                const auto fresh = [&](int c) {
                    return normal(key, origin.x + x - kReach, origin.y + y0 + y - kReach, c);
                };
                const std::array<float, 3> n{fresh(0), fresh(1), fresh(2)};
                float* w = white.pixel(x, y);
                w[0] = m[0] * n[0];
                w[1] = m[1] * n[0] + m[2] * n[1];
                w[2] = m[3] * n[0] + m[4] * n[1] + m[5] * n[2];
            }
        }
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < display.width(); ++x) {
                if (matte.row(y)[x] == 0) continue;
                std::array<float, 3> shaped{};
                for (int v = 0; v < kSide; ++v) {
                    const float* w = white.pixel(x, y - y0 + v);
                    for (int u = 0; u < kSide; ++u, w += 3) {
                        const auto k = static_cast<std::size_t>(v * kSide + u);
                        for (std::size_t c = 0; c < 3; ++c)
                            shaped[c] += model.kernel[c][k] * w[c];
                    }
                }
                float* p = display.pixel(x, y);
                const float at =
                    std::clamp(luma_601(p) * kBins - 0.5f, 0.0f, static_cast<float>(kBins) - 1.0f);
                const auto b = static_cast<std::size_t>(at);
                const std::size_t next = std::min<std::size_t>(b + 1, kBins - 1);
                const float t = at - static_cast<float>(b);
                for (std::size_t c = 0; c < 3; ++c) {
                    const float deviation = model.deviation[c][b] +
                                            t * (model.deviation[c][next] - model.deviation[c][b]);
                    p[c] += strength * deviation * shaped[c];
                }
            }
        }
    });
}

}  // namespace weft

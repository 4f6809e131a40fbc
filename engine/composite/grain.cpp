#include "engine/composite/grain.h"

#include <algorithm>
#include <cmath>

#include "engine/core/luma.h"
#include "engine/core/parallel.h"
#include "engine/core/rng.h"

namespace weft {
namespace {

// Random numbers of deviation 1 for the three channels of a pixel of the plate: the sum of four
// uniform ones is normal enough, and needs no function whose last bit may differ between machines.
std::array<float, 3> normals(std::uint64_t key, int x, int y) {
    const auto place = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) |
                       static_cast<std::uint32_t>(y);
    const std::uint64_t here = mix64(key ^ mix64(place));
    std::array<float, 3> out;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::uint64_t bits = mix64(here + c);
        std::uint32_t sum = 0;
        for (int k = 0; k < 4; ++k)
            sum += static_cast<std::uint32_t>((bits >> (16 * k)) & 0xffff);
        constexpr float kMean = 4 * 32767.5f, kDeviation = 37837.2f;  // 2 · 65536 / √12
        out[c] = (static_cast<float>(sum) - kMean) / kDeviation;
    }
    return out;
}

// Rows of grain for each channel: white noise, its channels mixed, and the same filtered.
struct GrainRows {
    GrainRows(int width, int rows)
        : white{ImageF1(width + 2 * GrainModel::kRadius, rows + 2 * GrainModel::kRadius),
                ImageF1(width + 2 * GrainModel::kRadius, rows + 2 * GrainModel::kRadius),
                ImageF1(width + 2 * GrainModel::kRadius, rows + 2 * GrainModel::kRadius)},
          shaped{ImageF1(width, 1), ImageF1(width, 1), ImageF1(width, 1)} {}

    // (x0, y0): the plate's pixel of the first white one.
    void draw(const GrainModel& model, std::uint64_t key, int x0, int y0) {
        const auto& m = model.mix;
        for (int y = 0; y < white[0].height(); ++y) {
            for (int x = 0; x < white[0].width(); ++x) {
                const std::array<float, 3> n = normals(key, x0 + x, y0 + y);
                white[0].row(y)[x] = m[0] * n[0];
                white[1].row(y)[x] = m[1] * n[0] + m[2] * n[1];
                white[2].row(y)[x] = m[3] * n[0] + m[4] * n[1] + m[5] * n[2];
            }
        }
    }

    void filter(const GrainModel& model, int y) {
        for (std::size_t c = 0; c < 3; ++c) {
            float* out = shaped[c].row(0);
            const int width = shaped[c].width();
            std::fill_n(out, width, 0.0f);
            for (int k = 0; k < GrainModel::kSide * GrainModel::kSide; ++k) {
                const float tap = model.kernel[c][static_cast<std::size_t>(k)];
                const float* in = white[c].row(y + k / GrainModel::kSide) + k % GrainModel::kSide;
                for (int x = 0; x < width; ++x)
                    out[x] += tap * in[x];
            }
        }
    }

    std::array<ImageF1, 3> white, shaped;
};

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
    parallel_rows(display.height(), 16, [&](int y0, int y1) {
        GrainRows rows(display.width(), y1 - y0);
        rows.draw(model, key, origin.x - GrainModel::kRadius, origin.y + y0 - GrainModel::kRadius);
        for (int y = y0; y < y1; ++y) {
            rows.filter(model, y - y0);
            for (int x = 0; x < display.width(); ++x) {
                if (matte.row(y)[x] == 0) continue;
                float* p = display.pixel(x, y);
                const float at = std::clamp(luma_601(p) * GrainModel::kBins - 0.5f, 0.0f,
                                            static_cast<float>(GrainModel::kBins) - 1.0f);
                const auto b = static_cast<std::size_t>(at);
                const std::size_t next = std::min<std::size_t>(b + 1, GrainModel::kBins - 1);
                const float t = at - static_cast<float>(b);
                for (std::size_t c = 0; c < 3; ++c) {
                    const float deviation = model.deviation[c][b] +
                                            t * (model.deviation[c][next] - model.deviation[c][b]);
                    p[c] += strength * deviation * rows.shaped[c].row(0)[x];
                }
            }
        }
    });
}

}  // namespace weft

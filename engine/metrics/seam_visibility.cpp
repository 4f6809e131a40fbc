#include "engine/metrics/seam_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/core/luma.h"

namespace weft {
namespace {

constexpr int kBlock_px = 32;
// Steps are counted in steps of a just noticeable one: about 1 % of white, or 2 % of the luma.
constexpr float kJnd = 0.01f, kJndOfLuma = 0.02f;
constexpr int kSteepBins = 128;
constexpr float kBin = 0.5f;  // in just noticeable steps
// What exceeds this share of the texture around a seam stands out.
constexpr double kNearlyAll = 0.98;

using Histogram = std::array<std::int32_t, kSteepBins>;

float steps_at(const ImageF3& pixels, int x, int y) {
    const float here = luma_709(pixels.pixel(x, y));
    const float right = luma_709(pixels.pixel(x + 1, y)), below = luma_709(pixels.pixel(x, y + 1));
    const float step = std::max(std::abs(right - here), std::abs(below - here));
    return step / std::max(kJnd, kJndOfLuma * std::abs(here));
}

int bin_of(float steps) {
    return std::clamp(static_cast<int>(steps / kBin), 0, kSteepBins - 1);
}

// By blocks, of the texture beside the seams.
struct Surroundings {
    int columns = 0, rows = 0;
    std::vector<Histogram> blocks;

    // The bin which nearly all around the block lie below; nothing: nothing is there.
    [[nodiscard]] int limit_around(int column, int row) const {
        Histogram sum{};
        std::int64_t count = 0;
        for (int y = std::max(0, row - 1); y <= std::min(rows - 1, row + 1); ++y)
            for (int x = std::max(0, column - 1); x <= std::min(columns - 1, column + 1); ++x) {
                const Histogram& block = blocks[static_cast<std::size_t>(y * columns + x)];
                for (std::size_t k = 0; k < kSteepBins; ++k) {
                    sum[k] += block[k];
                    count += block[k];
                }
            }
        constexpr std::int64_t kLeast = 64;
        if (count < kLeast) return kSteepBins;
        const auto most = static_cast<std::int64_t>(kNearlyAll * static_cast<double>(count));
        std::int64_t below = 0;
        for (int k = 0; k < kSteepBins; ++k)
            if ((below += sum[static_cast<std::size_t>(k)]) >= most) return k;
        return kSteepBins - 1;
    }
};

template <class Visit>
void visit_covered(const ImageF3& pixels, const Matte& touched, Visit&& visit) {
    for (int y = 0; y + 1 < pixels.height(); ++y)
        for (int x = 0; x + 1 < pixels.width(); ++x)
            if (touched.at(x, y) == 255 && touched.at(x + 1, y) == 255 &&
                touched.at(x, y + 1) == 255)
                visit(x, y);
}

}  // namespace

float seam_visibility(const ImageF3& pixels, const Matte& touched, const ImageF1& seam) {
    Surroundings around;
    around.columns = (pixels.width() + kBlock_px - 1) / kBlock_px;
    around.rows = (pixels.height() + kBlock_px - 1) / kBlock_px;
    around.blocks.assign(static_cast<std::size_t>(around.columns * around.rows), Histogram{});
    const auto block_of = [&](int x, int y) {
        return static_cast<std::size_t>(y / kBlock_px * around.columns + x / kBlock_px);
    };
    visit_covered(pixels, touched, [&](int x, int y) {
        if (seam.at(x, y) <= 0.5f)
            ++around
                  .blocks[block_of(x, y)][static_cast<std::size_t>(bin_of(steps_at(pixels, x, y)))];
    });
    std::vector<int> limits;
    for (int row = 0; row < around.rows; ++row)
        for (int column = 0; column < around.columns; ++column)
            limits.push_back(around.limit_around(column, row));
    // A step below the first whole one is not noticed, whatever is around it.
    constexpr int kNoticed = 2;
    std::int64_t count[2] = {0, 0}, stands_out[2] = {0, 0};
    visit_covered(pixels, touched, [&](int x, int y) {
        const int on = seam.at(x, y) > 0.5f ? 1 : 0;
        const int limit = std::max(kNoticed, limits[block_of(x, y)]);
        ++count[on];
        stands_out[on] += bin_of(steps_at(pixels, x, y)) > limit;
    });
    constexpr std::int64_t kLeast = 16;
    if (count[0] < kLeast || count[1] < kLeast) return -1;
    const double beside = static_cast<double>(stands_out[0]) / static_cast<double>(count[0]);
    const double on = static_cast<double>(stands_out[1]) / static_cast<double>(count[1]);
    return static_cast<float>(std::clamp(on - beside, 0.0, 1.0));
}

}  // namespace weft

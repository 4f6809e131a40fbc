#include "engine/motion/patch_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "engine/core/isa.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr int kPatch = 8, kStride = 4;
constexpr int kPixels = kPatch * kPatch;
constexpr float kShare = 1.0f / kPixels;
// A patch that has moved further than its size from where it started is lost.
constexpr float kFurthest_px = kPatch;
constexpr float kSettled_px = 0.005f;
// Differences of a few levels may be grain, and say nothing against a patch; levels².
constexpr float kGrain = 6;

// The source's patch: values, slopes, and the inverse of their normal equations.
struct Patch {
    alignas(32) std::array<float, kPixels> value, gx, gy;
    Vec2 sum_g{0};
    glm::vec3 inverse{0};  // xx, xy, yy
};

// How well a displacement fits: the squared difference less that of the means, which a change of
// light explains; and the step that Gauss–Newton takes from there.
struct Fit {
    float cost;
    Vec2 step;
};

// Whether another displacement is worth a try.
bool apart(Vec2 a, Vec2 b) {
    constexpr float kApart_px = 0.25f;
    return glm::dot(a - b, a - b) > kApart_px * kApart_px;
}

// Where a patch lies in the target: its top left pixel, and the fractions beyond it.
struct Place {
    const float* pixel;
    float fx, fy;
};

struct Found {
    Vec2 d;
    float cost;
};

// All patches of a level.
struct PatchGrid {
    const SearchPicture& source;
    const SearchPicture& target;
    const ImageF2& coarser;
    int iterations;
    int columns, rows;
    std::vector<Found> found;

    static int count(int extent) {
        return std::max(0, (extent - kPatch + kStride - 1) / kStride) + 1;
    }
    [[nodiscard]] Found& at(int column, int row) {
        return found[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)];
    }
    [[nodiscard]] static Vec2 origin(int column, int row) {
        return {static_cast<float>(column * kStride), static_cast<float>(row * kStride)};
    }
    [[nodiscard]] Vec2 expected(int column, int row) const {
        if (coarser.empty()) return Vec2(0);
        const int x = std::min((column * kStride + kPatch / 2) / 2, coarser.width() - 1);
        const int y = std::min((row * kStride + kPatch / 2) / 2, coarser.height() - 1);
        const float* d = coarser.pixel(x, y);
        return {2 * d[0], 2 * d[1]};
    }
};

// Σ weight and Σ weight · motion of a band of rows.
struct VoteSums {
    ImageF1 weight, x, y;
    explicit VoteSums(Size size) : weight(size), x(size), y(size) {}
};

namespace portable {
constexpr int kRegister = 4;
#include "engine/motion/patch_kernels.inl"
}  // namespace portable

#if defined(__x86_64__)
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
namespace avx2 {
constexpr int kRegister = 8;
#include "engine/motion/patch_kernels.inl"
}  // namespace avx2
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif

void search_band(PatchGrid& grid, int r0, int r1) {
#if defined(__x86_64__)
    if (current_isa() != Isa::kScalar) return avx2::search_band(grid, r0, r1);
#endif
    portable::search_band(grid, r0, r1);
}

void vote_band(PatchGrid& grid, int y0, int y1, VoteSums& sums) {
#if defined(__x86_64__)
    if (current_isa() != Isa::kScalar) return avx2::vote_band(grid, y0, y1, sums);
#endif
    portable::vote_band(grid, y0, y1, sums);
}

// Each pixel's motion: the mean of what the patches over it found, weighted by how well they fit
// there.
ImageF2 dense_motion(PatchGrid& grid) {
    ImageF2 out(grid.source.size());
    const int width = (grid.columns - 1) * kStride + kPatch;
    parallel_rows(out.height(), 32, [&](int y0, int y1) {
        VoteSums sums(Size{width, y1 - y0});
        vote_band(grid, y0, y1, sums);
        for (int y = y0; y < y1; ++y) {
            float* row = out.row(y);
            const float* const w = sums.weight.row(y - y0);
            const float *u = sums.x.row(y - y0), *v = sums.y.row(y - y0);
            for (int x = 0; x < out.width(); ++x) {
                row[2 * x] = u[x] / w[x];
                row[2 * x + 1] = v[x] / w[x];
            }
        }
    });
    return out;
}

}  // namespace

SearchPicture::SearchPicture(Size size)
    : size_(size), pixels_(size.width + 2 * kBorder, size.height + 2 * kBorder) {}

SearchPicture::SearchPicture(ViewU8x1 luma) : SearchPicture(luma.size()) {
    for (int y = 0; y < size_.height; ++y) {
        const std::uint8_t* in = luma.row(y);
        std::copy(in, in + size_.width, pixels_.pixel(kBorder, y + kBorder));
    }
    repeat_border();
}

void SearchPicture::repeat_border() {
    for (int y = kBorder; y < kBorder + size_.height; ++y) {
        float* row = pixels_.row(y);
        std::fill(row, row + kBorder, row[kBorder]);
        float* end = row + kBorder + size_.width;
        std::fill(end, end + kBorder, end[-1]);
    }
    const auto repeat = [&](int from, int to) {
        std::copy(pixels_.row(from), pixels_.row(from) + pixels_.stride(), pixels_.row(to));
    };
    for (int y = 0; y < kBorder; ++y) {
        repeat(kBorder, y);
        repeat(kBorder + size_.height - 1, kBorder + size_.height + y);
    }
}

SearchPicture SearchPicture::halved() const {
    SearchPicture out(Size{(size_.width + 1) / 2, (size_.height + 1) / 2});
    for (int y = 0; y < out.size_.height; ++y) {
        const float *a = at(0, 2 * y), *b = at(0, 2 * y + 1);
        float* row = out.pixels_.pixel(kBorder, y + kBorder);
        for (int x = 0; x < out.size_.width; ++x)
            row[x] = 0.25f * ((a[2 * x] + a[2 * x + 1]) + (b[2 * x] + b[2 * x + 1]));
    }
    out.repeat_border();
    return out;
}

std::vector<SearchPicture> search_pyramid(ViewU8x1 luma) {
    std::vector<SearchPicture> levels{SearchPicture(luma)};
    constexpr int kLeast = 3 * kPatch;
    while (std::min(levels.back().size().width, levels.back().size().height) >= kLeast)
        levels.push_back(levels.back().halved());
    return levels;
}

ImageF2 search_level(const SearchPicture& source, const SearchPicture& target,
                     const ImageF2& coarser, int iterations) {
    const int columns = PatchGrid::count(source.size().width);
    const int rows = PatchGrid::count(source.size().height);
    PatchGrid grid{source, target, coarser, iterations, columns, rows, {}};
    grid.found.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    // Propagation between neighbours ends at the bands, which do not depend on the threads.
    constexpr int kBand = 16;
    parallel_rows(rows, kBand, [&](int r0, int r1) { search_band(grid, r0, r1); });
    return dense_motion(grid);
}

}  // namespace weft

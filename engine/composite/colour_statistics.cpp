#include "engine/composite/colour_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr float kRimWeight = 0.05f;  // next to soft pixels, even a whole one may be slightly mixed
constexpr float kLevelFactor = 1.0f / 32.0f;
constexpr float kEnough = 64.0f;  // times the most that coarser levels could still add

void add(ColourSums& to, const ColourSums& from, float share) {
    for (std::size_t k = 0; k < 8; ++k)
        to.v[k] += share * from.v[k];
}

void add_pixel(ColourSums& s, const float* p, float w) {
    s.v[0] += w;
    for (std::size_t c = 0; c < 3; ++c) {
        s.v[1 + c] += w * p[c];
        s.v[4 + c] += w * p[c] * p[c];
    }
}

// True if all eight neighbours have the matte value of (x, y), also beyond the border.
bool surrounded(ViewU8x1 matte, int x, int y) {
    const int x0 = std::max(0, x - 1), x1 = std::min(matte.width() - 1, x + 1);
    const std::uint8_t own = matte.row(y)[x];
    for (int v = std::max(0, y - 1); v <= std::min(matte.height() - 1, y + 1); ++v) {
        const std::uint8_t* row = matte.row(v);
        if (row[x0] != own || row[x] != own || row[x1] != own) return false;
    }
    return true;
}

}  // namespace

ColourPyramid::ColourPyramid(ViewF3 plate, ViewU8x1 matte, const Recti& box) : box_(box) {
    build_first(plate, matte);
    while (levels_.back().width > 1 || levels_.back().height > 1)
        build_next();
}

void ColourPyramid::build_first(ViewF3 plate, ViewU8x1 matte) {
    Level level{(box_.width() + 1) / 2, (box_.height() + 1) / 2, {}};
    level.cells.resize(static_cast<std::size_t>(level.width) *
                       static_cast<std::size_t>(level.height));
    parallel_rows(level.height, 8, [&](int j0, int j1) {
        for (int y = box_.y0 + 2 * j0; y < std::min(box_.y1, box_.y0 + 2 * j1); ++y) {
            NearColours* cells =
                level.cells.data() + static_cast<std::ptrdiff_t>((y - box_.y0) / 2) * level.width;
            const std::uint8_t* m = matte.row(y);
            for (int x = box_.x0; x < box_.x1; ++x) {
                if (m[x] != 0 && m[x] != 255) continue;
                const float* p = plate.pixel(x, y);
                if (!std::isfinite(p[0] + p[1] + p[2])) continue;
                NearColours& cell = cells[(x - box_.x0) / 2];
                add_pixel(m[x] ? cell.surface : cell.surroundings, p,
                          surrounded(matte, x, y) ? 1.0f : kRimWeight);
            }
        }
    });
    levels_.push_back(std::move(level));
}

void ColourPyramid::build_next() {
    const Level& fine = levels_.back();
    Level level{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
    level.cells.resize(static_cast<std::size_t>(level.width) *
                       static_cast<std::size_t>(level.height));
    parallel_rows(level.height, 8, [&](int j0, int j1) {
        for (int j = 2 * j0; j < std::min(fine.height, 2 * j1); ++j) {
            for (int i = 0; i < fine.width; ++i) {
                const NearColours& from =
                    fine.cells[static_cast<std::size_t>(j) * static_cast<std::size_t>(fine.width) +
                               static_cast<std::size_t>(i)];
                NearColours& to = level.cells[static_cast<std::size_t>(j / 2) *
                                                  static_cast<std::size_t>(level.width) +
                                              static_cast<std::size_t>(i / 2)];
                add(to.surface, from.surface, 1.0f);
                add(to.surroundings, from.surroundings, 1.0f);
            }
        }
    });
    levels_.push_back(std::move(level));
}

NearColours ColourPyramid::near(int x, int y) const {
    NearColours sums;
    float factor = 1.0f;
    float px = static_cast<float>(x - box_.x0) + 0.5f, py = static_cast<float>(y - box_.y0) + 0.5f;
    float pixels = 1.0f;  // in a block of this level
    for (const Level& level : levels_) {
        px *= 0.5f, py *= 0.5f, pixels *= 4.0f;
        const float reach = kEnough * factor * pixels;
        if (sums.surface.weight() > reach && sums.surroundings.weight() > reach) break;
        const float fx = std::clamp(px - 0.5f, 0.0f, static_cast<float>(level.width - 1));
        const float fy = std::clamp(py - 0.5f, 0.0f, static_cast<float>(level.height - 1));
        const int i = static_cast<int>(fx), j = static_cast<int>(fy);
        const float ax = fx - static_cast<float>(i), ay = fy - static_cast<float>(j);
        for (int v = 0; v < 2; ++v) {
            const float wy = v ? ay : 1.0f - ay;
            if (wy == 0) continue;
            const NearColours* row =
                level.cells.data() + static_cast<std::ptrdiff_t>(j + v) * level.width;
            for (int u = 0; u < 2; ++u) {
                const float w = factor * wy * (u ? ax : 1.0f - ax);
                if (w == 0) continue;
                add(sums.surface, row[i + u].surface, w);
                add(sums.surroundings, row[i + u].surroundings, w);
            }
        }
        factor *= kLevelFactor;
    }
    return sums;
}

}  // namespace weft

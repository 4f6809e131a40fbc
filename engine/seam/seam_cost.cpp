#include "engine/seam/seam_cost.h"

#include <cmath>
#include <vector>

namespace weft {
namespace {

int squared_distance(const std::uint8_t* a, const std::uint8_t* b) {
    const int r = a[0] - b[0], g = a[1] - b[1], l = a[2] - b[2];
    return r * r + g * g + l * l;
}

float distance(const std::uint8_t* a, const std::uint8_t* b) {
    return std::sqrt(static_cast<float>(squared_distance(a, b)));
}

}  // namespace

void fill_seam_costs(ViewU8x3 a, ViewU8x3 b, SeamProblem& problem, float gradient_floor) {
    const int w = problem.cells.width(), h = problem.cells.height();
    problem.right = Image<std::int32_t, 1>(w, h, 0);
    problem.down = Image<std::int32_t, 1>(w, h, 0);
    std::vector<float> here(static_cast<std::size_t>(w)), below(static_cast<std::size_t>(w));
    const auto mismatch = [&](int y, std::vector<float>& out) {
        for (int x = 0; x < w; ++x) {
            out[static_cast<std::size_t>(x)] = distance(a.pixel(x, y), b.pixel(x, y));
        }
    };
    const auto cost = [=](float sum, float gradient) {
        const float v = sum / (gradient + gradient_floor) * static_cast<float>(kSeamCostScale);
        return static_cast<std::int32_t>(v + 0.5f);
    };
    if (h > 0) mismatch(0, here);
    for (int y = 0; y < h; ++y) {
        const SeamCell* cells = problem.cells.row(y);
        const bool last = y + 1 == h;
        if (!last) mismatch(y + 1, below);
        const SeamCell* next = last ? nullptr : problem.cells.row(y + 1);
        for (int x = 0; x < w; ++x) {
            if (cells[x] == SeamCell::kOutside) continue;
            const std::uint8_t *pa = a.pixel(x, y), *pb = b.pixel(x, y);
            const auto i = static_cast<std::size_t>(x);
            if (x + 1 < w && cells[x + 1] != SeamCell::kOutside) {
                problem.right.row(y)[x] =
                    cost(here[i] + here[i + 1], distance(pa, pa + 3) + distance(pb, pb + 3));
            }
            if (next && next[x] != SeamCell::kOutside) {
                problem.down.row(y)[x] =
                    cost(here[i] + below[i],
                         distance(pa, pa + a.stride()) + distance(pb, pb + b.stride()));
            }
        }
        here.swap(below);
    }
}

void fill_paper_costs(ViewU8x3 a, ViewU8x3 b, ViewU8x3 target, ViewU8x1 known,
                      SeamProblem& problem) {
    const int w = problem.cells.width(), h = problem.cells.height();
    problem.right = Image<std::int32_t, 1>(w, h, 0);
    problem.down = Image<std::int32_t, 1>(w, h, 0);
    // Twice I, so that (A+B)/2 stays an integer.
    const auto twice = [&](int x, int y, int c) {
        const bool given = !known.empty() && known.at(x, y) != 0;
        return given ? 2 * target.at(x, y, c) : a.at(x, y, c) + b.at(x, y, c);
    };
    const auto cost = [&](int x, int y, int qx, int qy) {
        std::int64_t sum = 0;
        for (int c = 0; c < 3; ++c) {
            const int d = twice(x, y, c) - twice(qx, qy, c);
            sum += d * d;
        }
        constexpr std::int64_t kUnit = std::int64_t{4} * 255 * 255;
        return static_cast<std::int32_t>((sum * kSeamCostScale + kUnit / 2) / kUnit);
    };
    const auto takes_part = [&](int x, int y) {
        return problem.cells.at(x, y) != SeamCell::kOutside;
    };
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            if (!takes_part(x, y)) continue;
            if (x + 1 < w && takes_part(x + 1, y)) problem.right.at(x, y) = cost(x, y, x + 1, y);
            if (y + 1 < h && takes_part(x, y + 1)) problem.down.at(x, y) = cost(x, y, x, y + 1);
        }
    }
}

void fill_data_costs(ViewU8x3 a, ViewU8x3 b, ViewU8x3 target, ViewU8x1 known, float weight,
                     SeamProblem& problem) {
    const int w = problem.cells.width(), h = problem.cells.height();
    problem.old_cost = Image<std::int32_t, 1>(w, h, 0);
    problem.new_cost = Image<std::int32_t, 1>(w, h, 0);
    const float scale = weight * static_cast<float>(kSeamCostScale) / (255.0f * 255.0f);
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            if (problem.cells.at(x, y) == SeamCell::kOutside || known.at(x, y) == 0) continue;
            const std::uint8_t* t = target.pixel(x, y);
            const auto cost = [&](const std::uint8_t* p) {
                return static_cast<std::int32_t>(
                    scale * static_cast<float>(squared_distance(p, t)) + 0.5f);
            };
            problem.old_cost.at(x, y) = cost(a.pixel(x, y));
            problem.new_cost.at(x, y) = cost(b.pixel(x, y));
        }
    }
}

}  // namespace weft

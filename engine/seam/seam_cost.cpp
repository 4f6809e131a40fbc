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

void fill_seam_costs(ViewU8x3 a, ViewU8x3 b, SeamProblem& problem) {
    const int w = problem.cells.width(), h = problem.cells.height();
    problem.right = Image<std::int32_t, 1>(w, h, 0);
    problem.down = Image<std::int32_t, 1>(w, h, 0);
    std::vector<float> here(static_cast<std::size_t>(w)), below(static_cast<std::size_t>(w));
    const auto mismatch = [&](int y, std::vector<float>& out) {
        for (int x = 0; x < w; ++x) {
            out[static_cast<std::size_t>(x)] = distance(a.pixel(x, y), b.pixel(x, y));
        }
    };
    const auto cost = [](float sum, float gradient) {
        const float v = sum / (gradient + kGradientFloor) * static_cast<float>(kSeamCostScale);
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

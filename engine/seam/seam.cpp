#include "engine/seam/seam.h"

namespace weft {

std::int64_t seam_energy(const SeamProblem& problem, const Image<std::uint8_t, 1>& labels) {
    const int w = problem.cells.width(), h = problem.cells.height();
    const bool data = !problem.old_cost.empty();
    std::int64_t energy = 0;
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            if (problem.cells.at(x, y) == SeamCell::kOutside) continue;
            const std::uint8_t label = labels.at(x, y);
            if (data) energy += label ? problem.new_cost.at(x, y) : problem.old_cost.at(x, y);
            if (x + 1 < w && problem.cells.at(x + 1, y) != SeamCell::kOutside &&
                labels.at(x + 1, y) != label) {
                energy += problem.right.at(x, y);
            }
            if (y + 1 < h && problem.cells.at(x, y + 1) != SeamCell::kOutside &&
                labels.at(x, y + 1) != label) {
                energy += problem.down.at(x, y);
            }
        }
    }
    return energy;
}

SeamResult solve_seam(const SeamProblem& problem) {
    if (auto planar = solve_planar_dual(problem)) return std::move(*planar);
    return solve_grid_maxflow(problem);
}

SeamResult solve_direct(const SeamProblem& problem) {
    const int w = problem.cells.width(), h = problem.cells.height();
    SeamResult result;
    result.labels = Image<std::uint8_t, 1>(w, h, 0);
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const SeamCell c = problem.cells.at(x, y);
            result.labels.at(x, y) = c == SeamCell::kFree || c == SeamCell::kNew ? 1 : 0;
        }
    }
    result.energy = seam_energy(problem, result.labels);
    return result;
}

}  // namespace weft

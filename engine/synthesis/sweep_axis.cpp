#include "engine/synthesis/sweep_axis.h"

#include <algorithm>

namespace weft {
namespace {

constexpr int kLeastOverlap = 12;
constexpr int kLargestPatch = 200;
constexpr int kLargestWindow = 488;  // With the slack of the default overlap a transform of 512.

}  // namespace

SweepAxis make_sweep_axis(int sample_px, int plane_px, bool torus, int overlap_px, int period_px) {
    SweepAxis a;
    a.window = std::min(sample_px, kLargestWindow);
    a.overlap = std::min(overlap_px, sample_px / 2);
    int patch = std::min(a.window, kLargestPatch);
    if (torus) {
        patch = std::min(patch, std::max(1, plane_px - 2));
        a.overlap = std::min(a.overlap, patch / 3);
    }
    a.min_overlap = a.overlap >= 2 * kLeastOverlap
                        ? kLeastOverlap
                        : std::min(a.overlap, std::max(4, a.overlap / 2));
    if (period_px > a.overlap - a.min_overlap) {
        a.overlap = std::max(a.overlap, std::min(a.min_overlap + period_px, patch * 3 / 5));
    }
    int slack = a.overlap - a.min_overlap;
    a.block = patch + slack;
    if (torus && a.block > plane_px - 2) {
        slack = std::clamp(plane_px - 2 - patch, 0, slack);
        a.block = patch + slack;
    }
    a.lo = a.block - slack - a.window;
    a.hi = a.overlap - a.min_overlap;
    a.advance = std::max(1, a.block - slack - a.overlap);
    return a;
}

std::vector<int> window_starts(int sample_px, int window_px) {
    const int room = sample_px - window_px;
    const int windows = room == 0 ? 1 : 1 + (2 * room + window_px - 1) / window_px;
    std::vector<int> starts;
    for (int i = 0; i < windows; ++i)
        starts.push_back(windows == 1 ? 0 : room * i / (windows - 1));
    return starts;
}

}  // namespace weft

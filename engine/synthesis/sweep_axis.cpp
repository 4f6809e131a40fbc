#include "engine/synthesis/sweep_axis.h"

#include <algorithm>

namespace weft {
namespace {

constexpr int kLargestPatch = 200;
// With the slack of the default overlap a transform of 512.
constexpr int kLargestSweepWindow = 488;

struct Room {
    SweepAxis axis;
    int patch = 0;
};

Room room_for(int sample_px, int plane_px, bool torus, int overlap_px) {
    Room room;
    SweepAxis& a = room.axis;
    a.window = std::min(sample_px, kLargestSweepWindow);
    a.overlap = std::min(overlap_px, sample_px / 2);
    room.patch = std::min(a.window, kLargestPatch);
    if (torus) {
        room.patch = std::min(room.patch, std::max(1, plane_px - 2));
        a.overlap = std::min(a.overlap, room.patch / 3);
    }
    a.min_overlap = a.overlap >= 2 * kLeastOverlap
                        ? kLeastOverlap
                        : std::min(a.overlap, std::max(4, a.overlap / 2));
    return room;
}

SweepAxis finished(Room room, int plane_px, bool torus) {
    SweepAxis a = room.axis;
    int slack = a.overlap - a.min_overlap;
    a.block = room.patch + slack;
    if (torus && a.block > plane_px - 2) {
        slack = std::clamp(plane_px - 2 - room.patch, 0, slack);
        a.block = room.patch + slack;
    }
    a.lo = a.block - slack - a.window;
    a.hi = a.overlap - a.min_overlap;
    a.advance = std::max(1, a.block - slack - a.overlap);
    return a;
}

}  // namespace

SweepAxis make_sweep_axis(int sample_px, int plane_px, bool torus, int overlap_px, int period_px) {
    Room room = room_for(sample_px, plane_px, torus, overlap_px);
    SweepAxis& a = room.axis;
    if (period_px > a.overlap - a.min_overlap) {
        a.overlap = std::max(a.overlap, std::min(a.min_overlap + period_px, room.patch * 3 / 5));
    }
    return finished(room, plane_px, torus);
}

std::optional<SweepAxis> make_ranged_axis(int sample_px, int plane_px, bool torus, int overlap_px,
                                          int range_px) {
    Room room = room_for(sample_px, plane_px, torus, overlap_px);
    SweepAxis& a = room.axis;
    a.overlap = std::max(a.overlap, a.min_overlap + range_px - (a.window - room.patch));
    if (3 * a.overlap > 2 * room.patch) return std::nullopt;
    a = finished(room, plane_px, torus);
    if (a.hi - a.lo < range_px) return std::nullopt;
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

std::optional<SweepAxes> make_lattice_axes(const PlaneLattice& lattice, Size sample, Size plane,
                                           bool torus, int overlap_px) {
    std::optional<SweepAxes> best;
    for (const Size range : lattice.covers()) {
        const auto x = make_ranged_axis(sample.width, plane.width, torus, overlap_px, range.width);
        const auto y =
            make_ranged_axis(sample.height, plane.height, torus, overlap_px, range.height);
        if (!x || !y) continue;
        if (!best || x->advance * y->advance > best->x.advance * best->y.advance)
            best = SweepAxes{*x, *y};
    }
    return best;
}

}  // namespace weft

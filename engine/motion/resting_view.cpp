#include "engine/motion/resting_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/median.h"
#include "engine/motion/edge_direction.h"

namespace weft {
namespace {

constexpr int kPatchReach = 3;  // px, of a patch to either side of its middle
constexpr int kBeside = 2;      // px, at which a patch must fit less well
constexpr int kPatchMargin = kPatchReach + kBeside + 1;
constexpr double kStructure = 4 * 4;  // the least square of a deviation

// A patch of both frames: its means, deviations and their product, in 8-bit levels.
struct Pair {
    double mean_a = 0, mean_b = 0, square_a = 0, square_b = 0, product = 0;

    [[nodiscard]] double correlation() const {
        return product / std::sqrt(std::max(square_a * square_b, 1e-9));
    }
};

Pair pair_at(ViewU8x1 a, ViewU8x1 b, Vec2i at_a, Vec2i at_b) {
    constexpr int kCount = (2 * kPatchReach + 1) * (2 * kPatchReach + 1);
    int sum_a = 0, sum_b = 0, squares_a = 0, squares_b = 0, products = 0;
    for (int y = -kPatchReach; y <= kPatchReach; ++y) {
        const std::uint8_t *pa = a.row(at_a.y + y) + at_a.x, *pb = b.row(at_b.y + y) + at_b.x;
        for (int x = -kPatchReach; x <= kPatchReach; ++x) {
            sum_a += pa[x], squares_a += pa[x] * pa[x];
            sum_b += pb[x], squares_b += pb[x] * pb[x];
            products += pa[x] * pb[x];
        }
    }
    const double n = kCount, mean_a = sum_a / n, mean_b = sum_b / n;
    return {mean_a, mean_b, squares_a / n - mean_a * mean_a, squares_b / n - mean_b * mean_b,
            products / n - mean_a * mean_b};
}

enum class Rest : std::uint8_t {
    kRests,
    kMoved,
    kBlank,   // nothing tells
    kChanged  // nothing tells, but it has another level
};

// Whether a place shows on both frames the same.
class PlaceTest {
  public:
    PlaceTest(ViewU8x1 anchor, ViewU8x1 cur) : anchor_(anchor), cur_(cur) {}

    [[nodiscard]] bool covers(Vec2i at) const {
        return at.x >= kPatchMargin && at.y >= kPatchMargin && at.x < cur_.width() - kPatchMargin &&
               at.y < cur_.height() - kPatchMargin;
    }
    // `sharply`: better than beside it, in every direction that its structure tells.
    [[nodiscard]] Rest at(Vec2i place, bool sharply) const {
        constexpr double kSame = 0.8, kWorse = 0.05, kBetter = 0.005;
        constexpr double kSameLevel = 6;
        const Pair here = pair_at(anchor_, cur_, place, place);
        if (std::min(here.square_a, here.square_b) < kStructure)
            return std::abs(here.mean_a - here.mean_b) < kSameLevel ? Rest::kBlank : Rest::kChanged;
        const double same = here.correlation();
        if (same < kSame) return Rest::kMoved;
        if (!sharply) return Rest::kRests;
        double worst = same, best = -1;
        for (const Vec2i by : {Vec2i(kBeside, 0), {-kBeside, 0}, {0, kBeside}, {0, -kBeside}}) {
            const double beside = pair_at(anchor_, cur_, place + by, place).correlation();
            worst = std::min(worst, beside);
            best = std::max(best, beside);
        }
        if (best > same + kBetter) return Rest::kMoved;
        return worst < same - kWorse ? Rest::kRests : Rest::kBlank;
    }

    // By how much it is beside its place along an axis, px: the top of a parabola through the
    // correlations there and a pixel to either side. Empty where these hardly differ.
    [[nodiscard]] std::optional<float> off(Vec2i place, Vec2i axis) const {
        constexpr double kTold = 0.02;
        const auto fit = [&](Vec2i at) { return pair_at(anchor_, cur_, at, place).correlation(); };
        const double here = fit(place), less = fit(place - axis), more = fit(place + axis);
        const double bend = 2 * here - less - more;
        if (bend < kTold) return std::nullopt;
        return static_cast<float>(std::clamp(0.5 * (more - less) / bend, -1.0, 1.0));
    }

  private:
    ViewU8x1 anchor_, cur_;
};

// How far the camera has given way, if it stands still.
std::optional<Vec2> camera_shift(const PlaceTest& test, Size size) {
    constexpr int kStep = 6;
    constexpr std::size_t kFewest = 8;
    constexpr double kGoodPart = 0.15;
    std::size_t rest = 0, moved = 0;
    std::vector<float> along_x, along_y;
    for (int y = kPatchMargin; y < size.height - kPatchMargin; y += kStep) {
        for (int x = kPatchMargin; x < size.width - kPatchMargin; x += kStep) {
            const Rest found = test.at({x, y}, true);
            moved += found == Rest::kMoved ? 1U : 0U;
            if (found != Rest::kRests) continue;
            ++rest;
            if (const auto off = test.off({x, y}, {1, 0})) along_x.push_back(*off);
            if (const auto off = test.off({x, y}, {0, 1})) along_y.push_back(*off);
        }
    }
    if (rest < kFewest || static_cast<double>(rest) < kGoodPart * static_cast<double>(rest + moved))
        return std::nullopt;
    return Vec2(weft::median_of(along_x, 0.0f), weft::median_of(along_y, 0.0f));
}

// The share of a surface's places of which something is true; 0 where there are none.
template <class Test>
double share_of(ViewU8x1 visible, const Test& test) {
    constexpr int kStep = 6;
    int all = 0, hits = 0;
    for (int y = kPatchMargin; y < visible.height() - kPatchMargin; y += kStep) {
        for (int x = kPatchMargin; x < visible.width() - kPatchMargin; x += kStep) {
            if (visible.at(x, y) < 128) continue;
            ++all;
            hits += test(Vec2i(x, y)) ? 1 : 0;
        }
    }
    return all > 0 ? static_cast<double>(hits) / all : 0.0;
}

// Of the surface's edge: places that rest, and places that do not though what is beyond them does.
struct EdgeCount {
    int rests = 0, moved = 0;
};

EdgeCount edge_of(const PlaceTest& test, ViewU8x1 visible) {
    constexpr float kAway_px = 7;
    EdgeCount out;
    for (int y = kPatchMargin; y < visible.height() - kPatchMargin; ++y) {
        for (int x = kPatchMargin; x < visible.width() - kPatchMargin; ++x) {
            if ((x + y) % 3 != 0 || visible.at(x, y) < 128) continue;
            if (visible.at(x - 1, y) >= 128 && visible.at(x + 1, y) >= 128 &&
                visible.at(x, y - 1) >= 128 && visible.at(x, y + 1) >= 128)
                continue;
            const Vec2 out_px = kAway_px * outwards(visible, x, y);
            const Vec2i beyond(x + static_cast<int>(std::lround(out_px.x)),
                               y + static_cast<int>(std::lround(out_px.y)));
            if (!test.covers(beyond) || visible.at(beyond.x, beyond.y) >= 128) continue;
            const Rest outside = test.at(beyond, false);
            if (outside == Rest::kMoved || outside == Rest::kChanged) continue;
            const Rest edge = test.at({x, y}, false);
            out.rests += edge == Rest::kRests;
            out.moved += edge == Rest::kMoved;
        }
    }
    return out;
}

}  // namespace

std::optional<Vec2> rests_in_view(ViewU8x1 before, ViewU8x1 now, ViewU8x1 visible) {
    constexpr int kFar = 4;
    const PlaceTest test(before, now);
    const auto shift = camera_shift(test, now.size());
    if (!shift) return std::nullopt;
    const auto moved = [&](Vec2i at) { return test.at(at, false) == Rest::kMoved; };
    if (share_of(visible, moved) > 0.5) return std::nullopt;
    const EdgeCount edge = edge_of(test, visible);
    return edge.rests >= kFar * edge.moved ? shift : std::nullopt;
}

double blank_share(ViewU8x1 luma, ViewU8x1 visible) {
    return share_of(visible,
                    [&](Vec2i at) { return pair_at(luma, luma, at, at).square_a < kStructure; });
}

}  // namespace weft

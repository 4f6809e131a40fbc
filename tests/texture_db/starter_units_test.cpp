// Lattices against the units by which the starter textures are drawn.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/synthesis/sample_lattice.h"
#include "engine/synthesis/texture_plane.h"
#include "texture_db/starter/starter.h"

namespace weft {
namespace {

// How far a move is from the nearest one that maps the pattern onto itself, px.
double off_unit(const StarterUnit& unit, glm::dvec2 move) {
    const glm::dvec2 a = unit.steps[0], b = unit.steps[1];
    if (unit.count == 1) {
        const double length = std::hypot(a.x, a.y);
        const double along = (move.x * a.x + move.y * a.y) / length;
        return std::abs(along - length * std::round(along / length));
    }
    const double det = a.x * b.y - b.x * a.y;
    const double i = (b.y * move.x - b.x * move.y) / det, j = (a.x * move.y - a.y * move.x) / det;
    const glm::dvec2 miss = (i - std::round(i)) * a + (j - std::round(j)) * b;
    return std::hypot(miss.x, miss.y);
}

constexpr double kTolerance_px = 1.6;

bool is_whole(const StarterUnit& unit, int count, const std::array<glm::dvec2, 2>& steps) {
    if (count < unit.count) return false;
    for (int k = 0; k < count; ++k)
        if (off_unit(unit, steps[static_cast<std::size_t>(k)]) > kTolerance_px) return false;
    return true;
}

// Along an axis the first move at which the sample resembles itself more than just before and
// after; 0 for none.
int finest_beat(const SelfMismatch& self, Vec2i axis) {
    const auto at = [&](int k) { return self.mismatch.at(k * axis.x + self.reach.x, k * axis.y); };
    const int reach = axis.x ? self.reach.x : self.reach.y;
    for (int k = 6; k < reach; ++k)
        if (at(k) < at(k - 1) && at(k) < at(k + 1) && at(k) < 0.9) return k;
    return 0;
}

struct Tally {
    int acted = 0, right = 0;
    [[nodiscard]] double share() const { return static_cast<double>(right) / acted; }
};

// Tuned on the even numbers; every third of each half here, all of them in docs/EVIDENCE.md.
TEST(StarterUnits, ALatticeIsMadeOfWholeUnits) {
    for (const int half : {0, 1}) {
        SCOPED_TRACE(half);
        Tally lattice, naive;
        for (const StarterItem& item : starter_catalogue()) {
            if (item.number % 6 != 2 + half) continue;
            // The families in which most members have a unit.
            static const std::set<std::string_view> kRegular{"brick", "tiles", "knit", "roof",
                                                             "wallpaper"};
            if (!kRegular.contains(item.family)) continue;
            const StarterPicture picture = make_starter(item, 96);
            if (picture.unit.count == 0) continue;
            const SelfMismatch self = self_mismatch(picture.pixels);
            const SampleLattice found = find_lattice(picture.pixels, self);
            lattice.acted += found.count > 0;
            lattice.right += found.count > 0 && is_whole(picture.unit, found.count, found.steps);
            const std::array<glm::dvec2, 2> beats{glm::dvec2(finest_beat(self, {1, 0}), 0),
                                                  glm::dvec2(0, finest_beat(self, {0, 1}))};
            naive.acted += beats[0].x > 0 && beats[1].y > 0;
            naive.right += beats[0].x > 0 && beats[1].y > 0 && is_whole(picture.unit, 2, beats);
        }
        EXPECT_GT(lattice.acted, 50);
        EXPECT_GT(lattice.share(), 0.9) << lattice.right << " of " << lattice.acted;
        EXPECT_LT(naive.share(), 0.7) << naive.right << " of " << naive.acted;
    }
}

// Unit breaks: the share of a plane's seams across which the pattern is not continued by whole
// units. 1 if all are slivers.
double unit_breaks(const Image<std::int32_t, 2>& source, const StarterUnit& unit) {
    const auto offset = [&](int x, int y) {
        return Vec2i(x - source.pixel(x, y)[0], y - source.pixel(x, y)[1]);
    };
    int seams = 0, broken = 0;
    for (int y = 0; y + 1 < source.height(); ++y) {
        for (int x = 0; x + 1 < source.width(); ++x) {
            for (const Vec2i next : {Vec2i(x + 1, y), Vec2i(x, y + 1)}) {
                const Vec2i jump = offset(next.x, next.y) - offset(x, y);
                if (jump == Vec2i(0, 0)) continue;
                ++seams;
                broken += off_unit(unit, jump) > 2 + kTolerance_px;
            }
        }
    }
    return seams ? static_cast<double>(broken) / seams : 0.0;
}

Image<std::int32_t, 2> tiled(Size size) {
    Image<std::int32_t, 2> out(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x)
            out.pixel(x, y)[0] = x % 96, out.pixel(x, y)[1] = y % 96;
    }
    return out;
}

TEST(StarterUnits, PlanesOfWholeUnitsHaveNoSlivers) {
    int judged = 0;
    double mean = 0, naive = 0;
    for (const StarterItem& item : starter_catalogue()) {
        if (item.number % 12 != 5 || (item.family != "brick" && item.family != "tiles")) continue;
        const StarterPicture picture = make_starter(item, 96);
        if (find_lattice(picture.pixels).count != 2) continue;
        PlaneOptions options;
        options.size = {384, 384};
        options.mode = PlaneMode::kAuto;
        options.tileable = options.whole_periods = true;
        const auto plane = grow_plane(picture.pixels, options);
        ASSERT_TRUE(plane);
        if (plane->stats.lattice.empty()) continue;
        ++judged;
        mean += unit_breaks(plane->source, picture.unit);
        naive += unit_breaks(tiled({384, 384}), picture.unit);
    }
    ASSERT_GT(judged, 4);
    EXPECT_LT(mean / judged, 0.1);
    EXPECT_GT(naive / judged, 0.5);
}

}  // namespace
}  // namespace weft

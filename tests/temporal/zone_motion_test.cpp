#include "engine/temporal/zone_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>

#include "engine/core/rng.h"
#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kZoneFrame{320, 200};
constexpr int kSpacing = 8;

float nearly_normal(Rng& rng) {
    float sum = -6;
    for (int k = 0; k < 12; ++k)
        sum += static_cast<float>(rng.uniform());
    return sum;
}

// A wall seen from the side that moves.
Vec2 wall(Vec2 p) {
    const float w = 1 + 0.0004f * p.x - 0.0002f * p.y;
    return Vec2(4 + 1.02f * p.x - 0.03f * p.y, -7 + 0.02f * p.x + 0.98f * p.y) / w;
}

LatticeField field_of(const std::function<Vec2(Vec2)>& lands) {
    LatticeField field(kZoneFrame, kSpacing);
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            const Vec2 p = field.node_position(i, j);
            field.set_node(i, j, lands(p) - p);
        }
    }
    return field;
}

Matte box(int x0, int y0, int x1, int y1) {
    Matte out(kZoneFrame);
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            out.at(x, y) = 255;
    return out;
}

const Matte& surface() {
    static const Matte matte = box(20, 20, 300, 180);
    return matte;
}
const Matte& zone() {
    static const Matte matte = box(120, 70, 200, 130);
    return matte;
}

bool in_zone(Vec2 p, float by = 0) {
    return p.x > 120 - by && p.x < 200 + by && p.y > 70 - by && p.y < 130 + by;
}

// The wall, with something else inside of the zone.
LatticeField disturbed(const std::function<Vec2(Vec2)>& by) {
    return field_of([&](Vec2 p) { return wall(p) + (in_zone(p) ? by(p) : Vec2(0)); });
}

Vec2 noise(Vec2 p) {
    Rng rng(static_cast<std::uint64_t>(1000 * p.x + p.y));
    return 3.0f * Vec2(nearly_normal(rng), nearly_normal(rng));
}

// The largest distance inside of the zone from where `lands` says.
float worst(const LatticeField& field, const std::function<Vec2(Vec2)>& lands, float within = 0) {
    float worst = 0;
    for (int y = 0; y < kZoneFrame.height; y += 4) {
        for (int x = 0; x < kZoneFrame.width; x += 4) {
            const Vec2 p(x, y);
            if (in_zone(p, -within)) worst = std::max(worst, distance(p + field.at(p), lands(p)));
        }
    }
    return worst;
}

// No pixel further than three spacings outside of the zone changes, by a bit.
void expect_same_outside(const LatticeField& before, const LatticeField& after) {
    const ImageF2 a = before.dense(rect_of(kZoneFrame)), b = after.dense(rect_of(kZoneFrame));
    for (int y = 0; y < kZoneFrame.height; ++y) {
        for (int x = 0; x < kZoneFrame.width; ++x) {
            if (in_zone(Vec2(x, y), 3 * kSpacing)) continue;
            ASSERT_EQ(a.pixel(x, y)[0], b.pixel(x, y)[0]) << x << "," << y;
            ASSERT_EQ(a.pixel(x, y)[1], b.pixel(x, y)[1]) << x << "," << y;
        }
    }
}

TEST(ZoneMotion, WithoutThePictureTheWallGoesOnThroughTheZone) {
    const LatticeField before = disturbed(noise);
    ASSERT_GT(worst(before, wall), 3);
    const LatticeField after = without_picture(before, {zone(), surface(), 1});
    EXPECT_LT(worst(after, wall), 0.2f);
    expect_same_outside(before, after);
}

TEST(ZoneMotion, WithoutThePictureWhatBendsAroundItBendsInside) {
    const auto bent = [](Vec2 p) { return wall(p) + Vec2(0, 4 * std::sin(p.x / 60)); };
    const LatticeField before =
        field_of([&](Vec2 p) { return bent(p) + (in_zone(p) ? noise(p) : Vec2(0)); });
    const LatticeField after = without_picture(before, {zone(), surface(), 1});
    EXPECT_LT(worst(after, bent), 0.8f);
}

TEST(ZoneMotion, AZoneOverTheWholeSurfaceMovesAsAPlane) {
    const LatticeField before = disturbed([](Vec2 p) { return 0.2f * noise(p); });
    ASSERT_GT(worst(before, wall), 0.8f);
    const Matte all = box(0, 0, kZoneFrame.width, kZoneFrame.height);
    EXPECT_LT(worst(without_picture(before, {all, zone(), 1}), wall), 0.4f);
}

TEST(ZoneMotion, StiffKeepsStraightLinesStraight) {
    const auto wobble = [](Vec2 p) { return Vec2(2 * std::sin(p.y / 5), 2 * std::sin(p.x / 6)); };
    const LatticeField before = disturbed(wobble);
    ASSERT_GT(worst(before, wall, 16), 1.8f);
    const LatticeField after = stiffened(before, {zone(), surface(), 1});
    EXPECT_LT(worst(after, wall, 16), 0.5f);
    expect_same_outside(before, after);
}

TEST(ZoneMotion, AStiffPieceThatMovesByItselfKeepsItsMotion) {
    const auto turned = [](Vec2 p) {
        const Vec2 q = p - Vec2(160, 100);
        return wall(p) + Vec2(-0.1f * q.y, 0.1f * q.x);
    };
    const LatticeField before = disturbed([&](Vec2 p) { return turned(p) - wall(p); });
    EXPECT_LT(worst(stiffened(before, {zone(), surface(), 1}), turned, 16), 0.6f);
}

TEST(ZoneMotion, CalmTakesWhatTremblesAndLeavesWhatBends) {
    // Bends more and more, and trembles.
    const auto lands = [](int frame, bool trembles) {
        return [frame, trembles](Vec2 p) {
            Rng rng(static_cast<std::uint64_t>(frame + 100));
            const Vec2 shake = trembles ? Vec2(nearly_normal(rng), nearly_normal(rng)) : Vec2(0);
            const float bump = in_zone(p) ? std::cos((p.x - 120) / 20 * 3.14159f) : 0;
            return wall(p) + bump * (Vec2(0, 0.2f * static_cast<float>(frame)) + shake);
        };
    };
    std::vector<OtherFrame> others;
    for (int d = -kCalm_frames; d <= kCalm_frames; ++d)
        if (d != 0) others.push_back({field_of(lands(d, true)), d});
    const LatticeField before = field_of(lands(0, true));
    const float was = worst(before, lands(0, false), 20);
    ASSERT_GT(was, 0.5f);
    const LatticeField after = calmed(before, {zone(), surface(), 1}, others);
    EXPECT_LT(worst(after, lands(0, false), 20), 0.5f * was);
    expect_same_outside(before, after);
    // At the end of the clip the frames before say it: no lag.
    std::erase_if(others, [](const OtherFrame& other) { return other.distance > 0; });
    std::vector<OtherFrame> steady;
    steady.reserve(others.size());
    for (const OtherFrame& other : others)
        steady.push_back({field_of(lands(other.distance, false)), other.distance});
    EXPECT_LT(worst(calmed(field_of(lands(0, false)), {zone(), surface(), 1}, steady),
                    lands(0, false), 20),
              0.25f);
}

TEST(ZoneMotion, SurroundingsCarryTheZone) {
    const LatticeField before = field_of([](Vec2 p) { return p; });
    const Matte ring = box(60, 30, 260, 170);
    const LatticeField after = with_surroundings(before, {zone(), zone(), 1}, field_of(wall), ring);
    EXPECT_LT(worst(after, wall), 0.3f);
}

TEST(ZoneMotion, HalfTheAmountGoesHalfTheWay) {
    const LatticeField before = disturbed(noise);
    const LatticeField whole = without_picture(before, {zone(), surface(), 1});
    const LatticeField half = without_picture(before, {zone(), surface(), 0.5f});
    const Vec2 p(160, 100);
    EXPECT_LT(distance(half.at(p), 0.5f * (before.at(p) + whole.at(p))), 1e-3f);
}

TEST(ZoneMotion, AnEmptyZoneChangesNothing) {
    const LatticeField before = disturbed(noise);
    const Matte none(kZoneFrame);
    EXPECT_EQ(without_picture(before, {none, surface(), 1}).nodes(), before.nodes());
    EXPECT_EQ(stiffened(before, {none, surface(), 1}).nodes(), before.nodes());
    EXPECT_EQ(calmed(before, {none, surface(), 1}, {}).nodes(), before.nodes());
    EXPECT_EQ(with_surroundings(before, {zone(), surface(), 1}, before, none).nodes(),
              before.nodes());
}

}  // namespace
}  // namespace weft

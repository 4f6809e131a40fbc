#include "engine/motion/moving_parts.h"

#include <gtest/gtest.h>

#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kBarFrame{256, 176};
constexpr Recti kBar{96, 48, 144, 120};

template <class Motion>
FlowField flow_of(const Motion& motion) {
    FlowField flow(kBarFrame);
    for (int y = 0; y < kBarFrame.height; ++y) {
        for (int x = 0; x < kBarFrame.width; ++x) {
            const Vec2 d = motion(centre_of(x, y));
            flow.d.pixel(x, y)[0] = d.x;
            flow.d.pixel(x, y)[1] = d.y;
        }
    }
    return flow;
}

Vec2 of_body(Vec2 p) {
    return {1 + 0.01f * p.x, 0.5f - 0.01f * p.y};
}

bool in_bar(Vec2 p) {
    return kBar.contains(static_cast<int>(p.x), static_cast<int>(p.y));
}

MovingParts found_in(const FlowField& flow) {
    return find_moving_parts(flow, Matte(kBarFrame, 255));
}

TEST(MovingParts, FindsWhatSlidesAlongTheBody) {
    const MovingParts found =
        found_in(flow_of([](Vec2 p) { return of_body(p) + (in_bar(p) ? Vec2(0, 5) : Vec2(0)); }));
    ASSERT_EQ(found.count, 1);
    EXPECT_EQ(found.at(kBar.x0 + 12, kBar.y0 + 12), 1);
    EXPECT_EQ(found.at(kBar.x1 - 4, kBar.y1 - 4), 1);
    EXPECT_EQ(found.at(kBar.x0 - 12, kBar.y0 + 12), MovingParts::kBody);
    EXPECT_EQ(found.at(kBarFrame.width - 1, kBarFrame.height - 1), MovingParts::kBody);
}

TEST(MovingParts, FindsAnArmThatIsJoinedAtOneEnd) {
    // Turns about its upper end, where it moves with the body.
    const MovingParts found = found_in(flow_of([](Vec2 p) {
        const Vec2 arm = p - Vec2(120, kBar.y0);
        return of_body(p) + (in_bar(p) ? 0.1f * Vec2(-arm.y, arm.x) : Vec2(0));
    }));
    ASSERT_EQ(found.count, 1);
    EXPECT_EQ(found.at(kBar.x0 + 20, kBar.y1 - 12), 1);
}

TEST(MovingParts, TellsTwoPartsThatTouch) {
    const MovingParts found = found_in(flow_of([](Vec2 p) {
        if (!in_bar(p)) return of_body(p);
        return of_body(p) + (p.x < 120 ? Vec2(0, 6) : Vec2(0, -6));
    }));
    ASSERT_EQ(found.count, 2);
    EXPECT_NE(found.at(104, 80), found.at(132, 80));
}

TEST(MovingParts, WhatBendsHasNone) {
    const MovingParts found = found_in(flow_of([](Vec2 p) {
        const float x = (p.x - 128) / 128, y = (p.y - 88) / 88;
        return Vec2(3 * x * x, 2 * x * y - 2 * y * y);
    }));
    EXPECT_EQ(found.count, 0);
}

TEST(MovingParts, WhatIsNotKnownBelongsToNobody) {
    FlowField flow = flow_of(of_body);
    for (int y = kBar.y0; y < kBar.y1; ++y)
        std::fill_n(flow.valid.pixel(kBar.x0, y), kBar.width(), std::uint8_t{0});
    const MovingParts found = found_in(flow);
    EXPECT_EQ(found.count, 0);
    EXPECT_EQ(found.at(kBar.x0 + 12, kBar.y0 + 12), MovingParts::kUnknown);
}

TEST(MovingParts, LooksInsideOfTheMatteOnly) {
    Matte visible(kBarFrame, 255);
    for (int y = kBar.y0 - 8; y < kBar.y1 + 8; ++y)
        std::fill_n(visible.pixel(kBar.x0 - 8, y), kBar.width() + 16, std::uint8_t{0});
    const FlowField flow =
        flow_of([](Vec2 p) { return of_body(p) + (in_bar(p) ? Vec2(0, 5) : Vec2(0)); });
    EXPECT_EQ(find_moving_parts(flow, visible).count, 0);
}

}  // namespace
}  // namespace weft

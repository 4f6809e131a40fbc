#include "engine/motion/stripes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kStripesFrame{200, 140};

Matte whole() {
    Matte out(kStripesFrame);
    std::fill(out.data(), out.data() + out.size_bytes(), std::uint8_t{255});
    return out;
}

Matte lines(float angle_rad, float second = 0) {
    Rng rng(4);
    const Vec2 across(std::cos(angle_rad), std::sin(angle_rad)), along(-across.y, across.x);
    return draw(kStripesFrame, [&](Vec2 p) {
        const float noise = static_cast<float>(rng.uniform() - 0.5) * 4 / 255;
        return 0.5f + 0.2f * std::sin((p.x * across.x + p.y * across.y) / 3) +
               second * std::sin((p.x * along.x + p.y * along.y) / 3) + noise;
    });
}

TEST(Stripes, TheirDirectionIsFound) {
    for (const float angle : {0.0f, 0.4f, 1.57f, 2.5f}) {
        const Stripes found = stripes_of(lines(angle), whole());
        EXPECT_EQ(found.share, 1) << angle;
        const Vec2 across(std::cos(angle), std::sin(angle));
        EXPECT_LT(std::abs(found.along.x * across.x + found.along.y * across.y), 0.03f) << angle;
    }
}

TEST(Stripes, StructureInTwoDirectionsIsNone) {
    EXPECT_EQ(stripes_of(lines(0.3f, 0.15f), whole()).share, 0);
    const WaveTexture texture(3);
    EXPECT_EQ(stripes_of(draw(kStripesFrame, texture), whole()).share, 0);
    EXPECT_EQ(stripes_of(Matte(kStripesFrame), whole()).share, 0) << "a flat fill";
}

TEST(Stripes, BandsOfShadeAreNotPaint) {
    const WaveTexture texture(3);
    const Matte shaded = draw(kStripesFrame, [&](Vec2 p) {
        return (0.5f + 0.05f * (texture(p) - 0.5f)) * (1 + 0.5f * std::sin(p.y / 14));
    });
    EXPECT_GT(stripes_of(shaded, whole()).share, 0.5f);
    EXPECT_EQ(stripes_of(registration_picture(shaded, whole())).share, 0);
    const Stripes painted = stripes_of(registration_picture(lines(0.4f), whole()));
    EXPECT_EQ(painted.share, 1);
    EXPECT_LT(std::abs(painted.along.x * std::cos(0.4f) + painted.along.y * std::sin(0.4f)), 0.03f);
}

TEST(Stripes, AMattesEdgeIsNoStructure) {
    Matte matte(kStripesFrame);
    for (int y = 30; y < 90; ++y)
        for (int x = 40; x < 160; ++x)
            matte.at(x, y) = 255;
    Matte luma = lines(0);
    for (int y = 0; y < kStripesFrame.height; ++y)
        for (int x = 0; x < kStripesFrame.width; ++x)
            if (matte.at(x, y) == 0) luma.at(x, y) = 255;
    EXPECT_EQ(stripes_of(luma, matte).share, 1);
}

TEST(Stripes, OnlyTheMotionAlongThemIsTakenFromTheOutline) {
    LatticeField field(kStripesFrame, 8), outline(kStripesFrame, 8);
    Matte above(kStripesFrame);
    for (int y = 0; y < 90; ++y)
        std::fill(above.row(y), above.row(y) + kStripesFrame.width, std::uint8_t{255});
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            field.set_node(i, j, {3, 0});
            // Right at the edge only.
            const float off = std::abs(field.node_position(i, j).y - 90) > 12 ? 9.0f : 0.0f;
            outline.set_node(i, j, {7, 2 + off});
        }
    }
    const Stripes upright{{0, 1}, 1}, half{{0, 1}, 0.5f}, level{{1, 0}, 1};
    EXPECT_LT(distance(along_stripes(field, outline, above, upright).at({90, 30}), {3, 2}), 0.3f);
    EXPECT_LT(distance(along_stripes(field, outline, above, half).at({90, 30}), {3, 1}), 0.2f);
    EXPECT_EQ(along_stripes(field, outline, above, level).nodes(), field.nodes())
        << "the edge runs along them";
    EXPECT_EQ(along_stripes(field, outline, whole(), upright).nodes(), field.nodes())
        << "the frame's border is no edge";
}

LatticeField uniform(Vec2 d) {
    LatticeField out(kStripesFrame, 8);
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i)
            out.set_node(i, j, d);
    }
    return out;
}

// A region with upright stripes whose lower edge shows.
Matte with_lower_edge() {
    Matte out(kStripesFrame);
    for (int y = 0; y < 90; ++y)
        std::fill(out.row(y), out.row(y) + kStripesFrame.width, std::uint8_t{255});
    return out;
}
constexpr Stripes kUpright{{0, 1}, 1};

TEST(Stripes, HowFarAMotionLeavesTheOutlineIsTold) {
    const Matte region = with_lower_edge();
    const auto departs = [&](Vec2 motion, const Matte& visible) {
        const LatticeField field = uniform(motion);
        return departure(field, along_stripes(field, uniform({0, 1}), region, kUpright), visible);
    };
    EXPECT_NEAR(departs({4, 11}, region), 10, 0.3f);
    EXPECT_NEAR(departs({4, 1}, region), 0, 0.1f) << "across them the picture tells";
    EXPECT_EQ(departs({4, 11}, Matte(kStripesFrame)), 0) << "nothing is visible";
}

TEST(Stripes, WhatSlidesFarAlongThemIsHeldByTheOutline) {
    const Matte region = with_lower_edge();
    const LatticeField outline = uniform({0, 0});
    // A shade drags one half by 9 px a step, here a large one; the other moves by itself.
    LatticeField dragged = uniform({2, 1});
    for (int j = 0; j < dragged.nodes().height(); ++j) {
        for (int i = 0; i < dragged.nodes().width(); ++i)
            if (dragged.node_position(i, j).x > 100) dragged.set_node(i, j, {2, 9});
    }
    const LatticeField kept =
        held_where_dragged(dragged, along_stripes(dragged, outline, region, kUpright));
    EXPECT_EQ(kept.at({40, 40}), dragged.at({40, 40}));
    EXPECT_LT(distance(kept.at({160, 40}), {2, 0}), 0.3f);
}

TEST(Stripes, ChangesCountAcrossThem) {
    const LatticeField before = uniform({1, 1}), now = uniform({4, 7});
    EXPECT_LT(distance(changed_across_stripes(now, before, kUpright).at({90, 30}), {4, 1}), 1e-4f);
    EXPECT_LT(distance(changed_across_stripes(now, before, {{0, 1}, 0.5f}).at({90, 30}), {4, 4}),
              1e-4f);
    EXPECT_EQ(changed_across_stripes(now, before, {{0, 1}, 0}).nodes(), now.nodes());
}

}  // namespace
}  // namespace weft

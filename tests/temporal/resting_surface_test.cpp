// A blank surface before a scene that rests, moves, or is seen by a camera that does.
#include "engine/temporal/resting_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/rng.h"
#include "engine/temporal/surface_walker.h"
#include "tests/motion/pictures.h"
#include "tests/temporal/picture_flow.h"

namespace weft {
namespace {

constexpr Size kTableFrame{320, 200};

struct Tabletop {
    float camera_px = 0;   // a frame, to the right
    float table_px = 0;    // a frame, by itself
    float cup_px = 6;      // a frame, before the table
    float brightness = 1;  // of all, a frame

    [[nodiscard]] bool on_table(Vec2 p, int t) const {
        const float x = p.x - (camera_px + table_px) * static_cast<float>(t);
        return x > 60 && x < 260 && p.y > 90 && p.y < 170;
    }
    [[nodiscard]] bool on_cup(Vec2 p, int t) const {
        return glm::length(p - Vec2(110 + cup_px * static_cast<float>(t), 110)) < 24;
    }
    // A blank table with a cup's soft shade on it, before a scene of structure.
    [[nodiscard]] Matte luma(int t) const {
        const WaveTexture scene(5), cup(9);
        const auto at = static_cast<float>(t);
        Rng rng(3, static_cast<std::uint64_t>(t));
        return draw(kTableFrame, [&](Vec2 p) {
            const float grain = 0.004f * static_cast<float>(rng.uniform() - 0.5);
            const float light = std::pow(brightness, at);
            const Vec2 off = p - Vec2(135 + cup_px * at, 120);
            if (on_cup(p, t)) return light * (0.2f + 0.3f * cup(p - Vec2(cup_px * at, 0))) + grain;
            if (on_table(p, t))
                return light * (0.62f - 0.15f * std::exp(-glm::dot(off, off) / 900)) + grain;
            return light * (0.15f + 0.4f * scene(p - Vec2(camera_px * at, 0))) + grain;
        });
    }
    [[nodiscard]] Matte matte(int t) const {
        return draw(kTableFrame,
                    [&](Vec2 p) { return on_table(p, t) && !on_cup(p, t) ? 1.0f : 0.0f; });
    }
    [[nodiscard]] StepFrame frame(int t) const { return {luma(t), matte(t), matte(t)}; }
    [[nodiscard]] bool rests(int t) const {
        return rests_where_seen(frame(0), frame(t)).has_value();
    }
    // The farthest that a walk takes its places in `frames` frames, px.
    [[nodiscard]] float walked(int frames) const {
        SurfaceWalker walker(luma(0), matte(0), {});
        for (int t = 1; t <= frames; ++t)
            walker.advance(luma(t), matte(t), flow_between(luma(t), luma(t - 1)));
        float most = 0;
        for (const Vec2 p : {Vec2(70, 100), {250, 100}, {70, 160}, {250, 160}, {160, 130}})
            most = std::max(most, glm::length(walker.ref_from_cur().at(p)));
        return most;
    }
};

TEST(RestingSurface, ABlankTableRestsWhileACupIsMovedOverIt) {
    const Tabletop scene;
    for (const int t : {1, 5, 10})
        EXPECT_TRUE(scene.rests(t)) << t;
    EXPECT_LT(scene.walked(10), 0.1f);
}

TEST(RestingSurface, GoesWithATripodThatGivesWay) {
    Tabletop scene;
    scene.camera_px = 0.06f;
    for (const int t : {1, 3, 5}) {
        const auto shift = rests_where_seen(scene.frame(0), scene.frame(t));
        ASSERT_TRUE(shift) << t;
        EXPECT_NEAR(shift->x, -0.06f * static_cast<float>(t), 0.06f) << t;
        EXPECT_NEAR(shift->y, 0, 0.06f) << t;
    }
}

TEST(RestingSurface, RestsInWhateverExposure) {
    Tabletop scene;
    scene.brightness = 1.06f;
    EXPECT_TRUE(scene.rests(1));
    EXPECT_TRUE(scene.rests(8));
}

TEST(RestingSurface, WhatMovesBeforeTheSceneDoesNot) {
    Tabletop scene;
    scene.table_px = 2;
    for (const int t : {1, 5, 10})
        EXPECT_FALSE(scene.rests(t)) << t;
}

TEST(RestingSurface, NothingRestsBeforeACameraThatMoves) {
    Tabletop scene;
    scene.camera_px = 1;
    scene.cup_px = 1;
    EXPECT_FALSE(scene.rests(2));
    EXPECT_FALSE(scene.rests(10));
}

TEST(RestingSurface, WhatIsSeenToMoveBehindAFrameMoves) {
    const WaveTexture landscape(21), frame(4);
    const auto window = draw(kTableFrame, [](Vec2 p) {
        return p.x > 60 && p.x < 260 && p.y > 40 && p.y < 160 ? 1.0f : 0.0f;
    });
    const auto luma = [&](int t) {
        return draw(kTableFrame, [&](Vec2 p) {
            const bool inside = p.x > 60 && p.x < 260 && p.y > 40 && p.y < 160;
            return inside ? 0.5f + 0.03f * landscape(p - Vec2(2 * static_cast<float>(t), 0))
                          : frame(p);
        });
    };
    const StepFrame first(luma(0), window, window), second(luma(1), window, window);
    LatticeField step(kTableFrame, 16), none(kTableFrame, 16);
    for (int j = 0; j < step.nodes().height(); ++j)
        for (int i = 0; i < step.nodes().width(); ++i)
            step.set_node(i, j, {-2, 0});
    EXPECT_TRUE(rests_where_seen(first, second).has_value()) << "by its edge";
    EXPECT_TRUE(clearly_moves(first, second, step));
    EXPECT_FALSE(clearly_moves(first, second, none));
}

}  // namespace
}  // namespace weft

// What is taken for a rigid plane, and what refutes it.
#include "engine/temporal/rigid_plane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/motion/flat_motion.h"
#include "engine/temporal/surface_walker.h"
#include "tests/motion/pictures.h"
#include "tests/temporal/picture_flow.h"

namespace weft {
namespace {

constexpr Size kWallFrame{256, 176};
constexpr int kWallFrames = 7;
constexpr float kJump_px = 2;  // a frame

// Where a place of frame t was on frame 0.
using Back = std::function<Vec2(Vec2, int)>;

// A camera that pans along a wall.
Vec2 panned(Vec2 p, int t) {
    return p + Vec2(1.5f * static_cast<float>(t), 0.4f * static_cast<float>(t));
}
// What waves, more and more.
Vec2 waving(Vec2 p, int t) {
    const float swing = 0.6f * static_cast<float>(t);
    return panned(p, t) + swing * Vec2(std::sin(p.y / 22), std::sin(p.x / 26));
}

struct Walked {
    bool is_plane = false, asks_outline = false;
    float off_plane_px = 0, error_px = 0;  // of the last frame, the most
};

// Somebody jumps before the wall whom the matte does not leave out.
bool is_jumper(Vec2 p, int t) {
    return std::abs(p.x - 110) < 14 && p.y > 90 - kJump_px * static_cast<float>(t);
}

// Wallpaper, whose stripes leave the motion along them nearly open.
float striped(Vec2 p, const WaveTexture& faint) {
    return 0.5f + 0.25f * std::sin(p.x / 2) + 0.06f * (faint(p) - 0.5f);
}

Walked walk_along(const Back& back, bool with_jumper, SurfaceKind kind, int frames = kWallFrames) {
    const WaveTexture wall(21), jumper(22);
    const auto luma_at = [&](int t) {
        return draw(kWallFrame, [&](Vec2 p) {
            if (!with_jumper) return wall(back(p, t));
            return is_jumper(p, t) ? jumper(p + Vec2(0, kJump_px * static_cast<float>(t)))
                                   : striped(back(p, t), wall);
        });
    };
    const Matte all(kWallFrame, 255);
    SurfaceWalkerOptions options;
    options.kind = kind;
    SurfaceWalker walker(luma_at(0), all, options);
    for (int t = 1; t < frames; ++t)
        walker.advance(luma_at(t), all, flow_between(luma_at(t), luma_at(t - 1)));
    Walked out{walker.is_plane(), walker.asks_outline()};
    const LatticeField& found = walker.ref_from_cur();
    const LatticeField plane = flattened(found, all);
    for (int y = 24; y < kWallFrame.height - 24; y += 4) {
        for (int x = 24; x < kWallFrame.width - 48; x += 4) {
            const Vec2 p = centre_of(x, y);
            if (with_jumper && is_jumper(p, frames - 1)) continue;
            const Vec2 at = p + found.at(p);
            out.off_plane_px = std::max(out.off_plane_px, distance(found.at(p), plane.at(p)));
            out.error_px = std::max(out.error_px, distance(at, back(p, frames - 1)));
        }
    }
    return out;
}

TEST(RigidPlane, WhoJumpsInFrontBendsNoWall) {
    const Walked found = walk_along(panned, true, SurfaceKind::kFound);
    EXPECT_TRUE(found.is_plane);
    EXPECT_LT(found.off_plane_px, 0.01f);
    EXPECT_LT(found.error_px, 0.3f);
    EXPECT_GT(walk_along(panned, true, SurfaceKind::kCloth).off_plane_px, 0.1f)
        << "where it may bend";
}

TEST(RigidPlane, WhatBendsRefutesIt) {
    const Walked found = walk_along(waving, false, SurfaceKind::kFound);
    EXPECT_FALSE(found.is_plane);
    EXPECT_LT(found.error_px, 1.0f);
}

// Once it has been borne out it is asked on some frames only whether it bends.
TEST(RigidPlane, WhatBendsLateRefutesItStill) {
    constexpr int kLong = 16, kStill = 8;
    const auto late = [](Vec2 p, int t) {
        const float swing = 0.25f * static_cast<float>(std::max(0, t - kStill));
        return panned(p, t) + swing * Vec2(std::sin(p.y / 22), std::sin(p.x / 26));
    };
    const Walked before = walk_along(late, false, SurfaceKind::kFound, kStill + 1);
    EXPECT_TRUE(before.is_plane);
    EXPECT_FALSE(before.asks_outline);
    EXPECT_LT(before.error_px, 0.1f);
    const Walked found = walk_along(late, false, SurfaceKind::kFound, kLong);
    EXPECT_FALSE(found.is_plane);
    EXPECT_TRUE(found.asks_outline);
    EXPECT_LT(found.error_px, 1.0f);
}

TEST(RigidPlane, AsksItsOutlineUntilItIsBorneOut) {
    constexpr int kFew = 4, kMany = 8;
    EXPECT_TRUE(walk_along(panned, false, SurfaceKind::kFound, kFew).asks_outline);
    EXPECT_TRUE(walk_along(panned, false, SurfaceKind::kPlane, kFew).asks_outline);
    EXPECT_FALSE(walk_along(panned, false, SurfaceKind::kFound, kMany).asks_outline);
    EXPECT_TRUE(walk_along(panned, false, SurfaceKind::kCloth, kMany).asks_outline);
}

TEST(RigidPlane, WhatIsSaidHoldsAgainstThePicture) {
    const Walked plane = walk_along(waving, false, SurfaceKind::kPlane);
    EXPECT_TRUE(plane.is_plane);
    EXPECT_LT(plane.off_plane_px, 0.01f);
    EXPECT_FALSE(walk_along(panned, false, SurfaceKind::kCloth).is_plane);
}

}  // namespace
}  // namespace weft

// A surface behind something that passes, and what of it is seen again.
#include "engine/mask/covered_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>

#include "engine/mask/signed_distance.h"
#include "engine/mask/uncovered.h"
#include "tests/mask/moving_disc.h"

namespace weft {
namespace {

constexpr int kPasses = 14;  // frames in which the disc passes

// A disc passes in front of a surface that is all the rest, and the matte gives nothing back.
struct Passage {
    test::DiscScene scene;
    float beyond_px = 0;  // how far around the disc its motion is measured, too
    Passage() {
        scene.start = {-30, 60};
        scene.step = {12, 0};
    }
    [[nodiscard]] ImageF1 distance(int t) const {
        Matte inside(scene.size, 255);
        for (int s = 0; s <= t; ++s) {
            const Matte disc = scene.matte(s);
            for (int y = 0; y < inside.height(); ++y)
                for (int x = 0; x < inside.width(); ++x)
                    if (disc.at(x, y) > 127) inside.at(x, y) = 0;
        }
        return signed_distance(inside_of(inside), 30);
    }
    [[nodiscard]] FlowField measured(int t) const {
        FlowField flow = scene.prev_from_cur(t);
        for (int y = 0; y < scene.size.height; ++y) {
            for (int x = 0; x < scene.size.width; ++x) {
                if (glm::distance(Vec2(x, y), scene.center(t)) > scene.radius_px + beyond_px)
                    continue;
                flow.d.at(x, y, 0) = -scene.step.x, flow.d.at(x, y, 1) = -scene.step.y;
            }
        }
        return flow;
    }
    // As seen on the last frame, with `shown` in place of the picture there if it is not empty.
    struct Odds {
        double again = 0, covered = 0, never = 0;  // shares above 0, below 0, and not 0
    };
    [[nodiscard]] Odds odds(const ImageU8x3& shown) const {
        CoveredSurface surface(scene.frame(0), distance(0));
        const ImageF2 still(scene.size);
        for (int t = 1; t <= kPasses; ++t) {
            const ImageU8x3 now = scene.frame(t), before = scene.frame(t - 1);
            const FlowField flow = measured(t);
            const Matte parting = parting_pixels(flow, rect_of(scene.size));
            const ImageF1 was = distance(t - 1), is = distance(t);
            surface.advance(
                {now, before, flow, parting, still, rect_of(scene.size), was, is, 1.0f});
        }
        const Matte disc = scene.matte(kPasses);
        const ImageF1 last = distance(kPasses);
        const ImageF1 log_odds = surface.odds(shown);
        Odds out;
        double again = 0, covered = 0, never = 0;
        for (int y = 0; y < disc.height(); ++y) {
            for (int x = 0; x < disc.width(); ++x) {
                if (last.at(x, y) > 0)
                    never += 1, out.never += log_odds.at(x, y) != 0 ? 1 : 0;
                else if (disc.at(x, y) > 127)
                    covered += 1, out.covered += log_odds.at(x, y) < 0 ? 1 : 0;
                else if (disc.at(x, y) == 0 && last.at(x, y) < -3)
                    again += 1, out.again += log_odds.at(x, y) > 0 ? 1 : 0;
            }
        }
        return {out.again / again, out.covered / covered, out.never / never};
    }
};

TEST(CoveredSurface, WhatIsSeenAgainIsToldFromWhatPasses) {
    const Passage passage;
    const Passage::Odds odds = passage.odds(passage.scene.frame(kPasses));
    EXPECT_GT(odds.again, 0.95);
    EXPECT_GT(odds.covered, 0.9);
    EXPECT_EQ(odds.never, 0);
}

// On a plain cloth nothing else tells how the cloth moves beside a hand.
TEST(CoveredSurface, MotionThatIsMeasuredBeyondWhatPassesIsNotTheSurfaces) {
    Passage passage;
    passage.beyond_px = 22;
    const Passage::Odds odds = passage.odds(passage.scene.frame(kPasses));
    EXPECT_GT(odds.again, 0.9);
    EXPECT_GT(odds.covered, 0.9);
}

// The wall behind a character who has turned sideways, say.
TEST(CoveredSurface, SomethingElseIsNotTheSurface) {
    const Passage passage;
    ImageU8x3 other = passage.scene.frame(kPasses);
    for (int y = 0; y < other.height(); ++y)
        for (int x = 0; x < 3 * other.width(); ++x)
            other.row(y)[x] = static_cast<std::uint8_t>(255 - other.row(y)[x]);
    EXPECT_LT(passage.odds(other).again, 0.1);
}

// What joined the matte some frames ago may have been a mistake: it does not come back.
TEST(CoveredSurface, OnlyWhatWasTheSurfacesOwnForSomeFramesCounts) {
    const test::DiscScene scene;
    const ImageU8x3 still_frame = scene.frame(0);
    const Size size = scene.size;
    const ImageF1 nothing(size, -20.0f), all(size, 20.0f);
    const FlowField rests(size);
    const Matte parting(size);
    const ImageF2 still(size);
    const auto odds_after = [&](int frames_inside) {
        CoveredSurface surface(still_frame, nothing);
        for (int t = 0; t <= frames_inside; ++t) {
            const bool leaves = t == frames_inside;
            surface.advance({still_frame, still_frame, rests, parting, still, rect_of(size),
                             t == 0 ? nothing : all, leaves ? nothing : all, 1.0f});
        }
        return surface.odds(still_frame).at(80, 60);
    };
    EXPECT_EQ(odds_after(3), 0);
    EXPECT_GT(odds_after(12), 0);
}

TEST(CoveredSurface, ASurfaceThatHasLeftThePictureIsNoError) {
    const test::DiscScene scene;
    const ImageU8x3 frame = scene.frame(0);
    const ImageF1 inside(scene.size, 20.0f), nothing(scene.size, -20.0f);
    CoveredSurface surface(frame, inside);
    const FlowField rests(scene.size);
    const Matte parting(scene.size);
    surface.advance({frame, frame, rests, parting, {}, {}, inside, nothing, 1.0f});
    EXPECT_EQ(surface.odds(frame).at(80, 60), 0);
}

}  // namespace
}  // namespace weft

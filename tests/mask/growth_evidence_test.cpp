#include "engine/mask/growth_evidence.h"

#include <gtest/gtest.h>

#include "engine/core/parallel.h"
#include "engine/mask/matte_propagation.h"
#include "engine/mask/signed_distance.h"
#include "tests/mask/moving_disc.h"

namespace weft {
namespace {

using test::DiscScene;

// The disc at time 1, everything that the functions need of the frames around it.
struct DiscWorld {
    DiscScene scene;
    ImageU8x3 before = scene.frame(0), now = scene.frame(1);
    ImageF1 prev_phi = signed_distance(inside_of(scene.matte(0)), 40);
    ImageF1 expected = signed_distance(inside_of(scene.matte(1)), 40);
    FlowField flow = scene.prev_from_cur(1);
    ImageF2 surface_motion{scene.size};
    DiscWorld() {
        for (int y = 0; y < scene.size.height; ++y) {
            for (int x = 0; x < scene.size.width; ++x) {
                surface_motion.pixel(x, y)[0] = -scene.step.x;
                surface_motion.pixel(x, y)[1] = -scene.step.y;
            }
        }
    }
    [[nodiscard]] GrowthInput input() const {
        return {now,    expected, surface_motion, {0, 0, scene.size.width, scene.size.height},
                before, prev_phi, &flow};
    }
};

// Colours that tell nothing, so that motion alone speaks.
SurfacePalette indifferent(Size size) {
    const ImageU8x3 grey(size, 128);
    ImageF1 halves(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x)
            halves.at(x, y) = x < size.width / 2 ? 10.0f : -10.0f;
    }
    return {grey, halves};
}

TEST(LimitGrowth, ReliableMotionFromOutsideTakesEvidenceForInsideBack) {
    DiscWorld w;
    w.now = ImageU8x3(w.scene.size, 128);
    ImageF1 odds(w.scene.size, 2.0f);
    limit_growth(odds, w.input(), indifferent(w.scene.size), 8);
    EXPECT_EQ(odds.at(5, 5), 0);  // stood still, outside
    const Vec2 c = w.scene.center(1);
    EXPECT_EQ(odds.at(static_cast<int>(c.x), static_cast<int>(c.y)), 2);
}

TEST(LimitGrowth, UnreliableMotionAndEvidenceForOutsideStay) {
    DiscWorld w;
    w.now = ImageU8x3(w.scene.size, 128);
    ImageF1 odds(w.scene.size, 2.0f);
    w.flow.valid.at(5, 5) = 0;
    odds.at(8, 5) = -1;
    limit_growth(odds, w.input(), indifferent(w.scene.size), 8);
    EXPECT_EQ(odds.at(5, 5), 2);
    EXPECT_EQ(odds.at(8, 5), -1);
}

// What differs from the background and has another thing's colours is not the surface.
TEST(LimitGrowth, ColoursOfOtherThingsSpeakAgainstInside) {
    DiscWorld w;
    w.flow.valid = Matte(w.scene.size);
    const SurfacePalette palette(w.before, w.prev_phi);
    ImageF1 odds(w.scene.size, 2.0f);
    limit_growth(odds, w.input(), palette, 8);
    EXPECT_LT(odds.at(5, 5), 0);
    EXPECT_GE(odds.at(5, 5), -0.5f);
    const Vec2 c = w.scene.center(1);
    EXPECT_EQ(odds.at(static_cast<int>(c.x), static_cast<int>(c.y)), 2);
}

TEST(SurfacePalette, KnowsHowForeignTheSurfacesOwnRarestColoursAre) {
    const DiscWorld w;
    const SurfacePalette palette(w.before, w.prev_phi);
    EXPECT_GT(palette.own_odds(0.1f), palette.odds(w.before.pixel(5, 5)));
    EXPECT_LE(palette.own_odds(0.1f), palette.own_odds(0.9f));
}

TEST(SurfaceDifference, IsSmallOnTheSurfaceAndUnknownElsewhere) {
    const DiscWorld w;
    const SurfacePalette palette(w.before, w.prev_phi);
    const ImageF1 d = surface_difference(w.input(), palette, 10);
    const Vec2 c = w.scene.center(1);
    const float here = d.at(static_cast<int>(c.x), static_cast<int>(c.y));
    EXPECT_GE(here, 0);
    EXPECT_LT(here, 8);
    EXPECT_EQ(d.at(5, 5), -1);
}

TEST(SurfacePalette, TellsTheColoursOfBothSidesApart) {
    const DiscWorld w;
    const SurfacePalette palette(w.before, w.prev_phi);
    const Vec2 c = w.scene.center(0);
    EXPECT_GT(palette.odds(w.before.pixel(static_cast<int>(c.x), static_cast<int>(c.y))), 0);
    EXPECT_LT(palette.odds(w.before.pixel(5, 5)), 0);
    const std::uint8_t nowhere[3] = {10, 250, 240};
    EXPECT_LT(palette.odds(nowhere), 0);
}

// A second object, of colours of its own, comes from outside and passes close to the disc. It
// differs from the background's clean plate, and is not the disc.
TEST(MatteWalker, AnObjectThatPassesIsNotTakenForTheSurface) {
    const DiscScene scene;
    DiscScene passing;
    passing.start = Vec2(120, 60);
    passing.step = Vec2(-3, 0.4f);
    passing.radius_px = 12;
    const auto frame = [&](int t) {
        ImageU8x3 f = scene.frame(t);
        const Matte m = passing.matte(t);
        for (int y = 0; y < f.height(); ++y) {
            for (int x = 0; x < f.width(); ++x) {
                if (m.at(x, y) < 128) continue;
                f.at(x, y, 0) = 40, f.at(x, y, 1) = static_cast<std::uint8_t>(60 + (y % 5) * 9);
                f.at(x, y, 2) = 190;
            }
        }
        return f;
    };
    MatteWalker walker(frame(0), scene.matte(0));
    for (int t = 1; t <= 6; ++t) {
        FlowField flow = scene.prev_from_cur(t);
        const Matte m = passing.matte(t);
        for (int y = 0; y < scene.size.height; ++y) {
            for (int x = 0; x < scene.size.width; ++x) {
                if (m.at(x, y) < 128) continue;
                flow.d.at(x, y, 0) = -passing.step.x;
                flow.d.at(x, y, 1) = -passing.step.y;
                flow.valid.at(x, y) = 255;
            }
        }
        const Matte found = walker.advance(frame(t), flow).matte;
        int taken = 0;
        for (int y = 0; y < scene.size.height; ++y) {
            for (int x = 0; x < scene.size.width; ++x)
                taken +=
                    m.at(x, y) >= 128 && scene.matte(t).at(x, y) < 128 && found.at(x, y) >= 128;
        }
        EXPECT_LT(taken, 12) << t;
        EXPECT_GT(test::overlap(found, scene.matte(t)), 0.95) << t;
    }
}

}  // namespace
}  // namespace weft

#include "engine/mask/departure.h"

#include <gtest/gtest.h>

#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr Size kDepartureFrame{320, 240};

// A square of 80 px that moves to the right by 4 px a frame over a background that stands still.
// `leak`: the frame before took in the strip of 24 px that it leaves behind as well.
struct LeavingSquare {
    Recti square{120, 80, 200, 160};
    FlowField flow{kDepartureFrame};

    void step() {
        square = {square.x0 + 4, square.y0, square.x1 + 4, square.y1};
        for (int y = 0; y < kDepartureFrame.height; ++y) {
            for (int x = 0; x < kDepartureFrame.width; ++x) {
                flow.d.pixel(x, y)[0] = square.contains(x, y) ? -4.0f : 0.0f;
                flow.d.pixel(x, y)[1] = 0;
                const bool uncovered =
                    x >= square.x0 - 4 && x < square.x0 && y >= square.y0 && y < square.y1;
                flow.valid.row(y)[x] = uncovered ? 0 : 1;
            }
        }
    }
    // Plain pictures, which tell no motions apart.
    [[nodiscard]] const ImageF1& advanced(Departure& departure, ViewF1 before) const {
        static const ImageU8x3 plain(kDepartureFrame);
        const ImageF2 surface(kDepartureFrame);
        return departure.advance(
            {before, flow, surface, plain, plain, rect_of(kDepartureFrame), 1});
    }
    [[nodiscard]] ImageF1 phi(int leak_px = 0) const {
        Matte inside(kDepartureFrame);
        for (int y = square.y0; y < square.y1; ++y)
            for (int x = square.x0 - leak_px; x < square.x1; ++x)
                inside.at(x, y) = 1;
        return signed_distance(inside, 40);
    }
};

TEST(Departure, SpeaksAgainstTheGroundThatIsUncoveredAndForWhatMovesOn) {
    LeavingSquare scene;
    Departure departure(scene.phi());
    ImageF1 odds;
    for (int frame = 0; frame < 6; ++frame) {
        const ImageF1 before = scene.phi(frame == 0 ? 0 : 4);
        scene.step();
        odds = scene.advanced(departure, before);
    }
    EXPECT_LT(odds.at(scene.square.x0 - 6, 120), -2) << "uncovered on the frame before";
    EXPECT_GT(odds.at(160, 120), 0) << "the surface";
    EXPECT_LT(odds.at(20, 20), -2) << "the background";
}

TEST(Departure, SparesWhatHasLongBeenInsideAndRests) {
    // The lower left corner of the surface stands still like the ground, as a foot does.
    LeavingSquare scene;
    Departure departure(scene.phi());
    const ImageF1 before = scene.phi();
    scene.step();
    const Recti foot{124, 140, 144, 160};
    for (int y = foot.y0; y < foot.y1; ++y)
        for (int x = foot.x0; x < foot.x1; ++x)
            scene.flow.d.pixel(x, y)[0] = 0;
    const ImageF1 odds = scene.advanced(departure, before);
    EXPECT_GT(odds.at(134, 150), -1);
    EXPECT_LT(odds.at(20, 20), -2);
}

TEST(Departure, SpeaksAgainstOldPixelsOnlyWhereThePictureTellsMotionsApart) {
    // As before, but the foot is too small to be what the surface does, and its picture stays where
    // it was, or is plain and moves with anything.
    const auto odds_of_foot = [](bool plain) {
        LeavingSquare scene;
        Departure departure(scene.phi());
        const ImageF1 before = scene.phi();
        scene.step();
        for (int y = 150; y < 158; ++y)
            for (int x = 130; x < 138; ++x)
                scene.flow.d.pixel(x, y)[0] = 0;
        ImageU8x3 picture(kDepartureFrame);
        for (int y = 0; y < kDepartureFrame.height; ++y)
            for (int x = 0; x < kDepartureFrame.width; ++x)
                picture.pixel(x, y)[1] = plain ? 90 : static_cast<std::uint8_t>(x * x * 7 + y * 53);
        ImageF2 surface(kDepartureFrame);
        for (int y = 0; y < kDepartureFrame.height; ++y)
            for (int x = 0; x < kDepartureFrame.width; ++x)
                surface.pixel(x, y)[0] = -4;
        return departure
            .advance({before, scene.flow, surface, picture, picture, rect_of(kDepartureFrame), 1})
            .at(134, 154);
    };
    EXPECT_GT(odds_of_foot(true), -0.2f);
    EXPECT_LT(odds_of_foot(false), odds_of_foot(true) - 0.1f);
}

TEST(Departure, SaysNothingOfASurfaceThatRestsOnItsBackground) {
    LeavingSquare scene;
    FlowField still(kDepartureFrame);
    for (int y = 0; y < kDepartureFrame.height; ++y)
        for (int x = 0; x < kDepartureFrame.width; ++x)
            still.valid.row(y)[x] = 1;
    Departure departure(scene.phi());
    scene.flow = still;
    const ImageF1 odds = scene.advanced(departure, scene.phi());
    for (int y = 0; y < kDepartureFrame.height; ++y)
        for (int x = 0; x < kDepartureFrame.width; ++x)
            ASSERT_EQ(odds.at(x, y), 0.0f) << x << ", " << y;
}

TEST(Departure, ForgetsWhatWasCorrected) {
    LeavingSquare scene;
    Departure departure(scene.phi());
    const ImageF1 before = scene.phi();
    scene.step();
    const float once = scene.advanced(departure, before).at(20, 20);
    Matte where(kDepartureFrame), inside(kDepartureFrame);
    where.at(20, 20) = 255;
    departure.correct(where, inside);
    const ImageF1 later = scene.phi();
    scene.step();
    const ImageF1& odds = scene.advanced(departure, later);
    EXPECT_NEAR(odds.at(20, 20), once, 0.01f);
    EXPECT_LT(odds.at(24, 20), once - 1);
}

TEST(Departure, SparesWhatWasConfirmedInside) {
    // A strip left of the surface, which rests, is painted in on the first frame or taken for it.
    constexpr int kStrip_px = 12;
    const auto odds_of = [](bool confirmed) {
        LeavingSquare scene;
        Departure departure(scene.phi());
        const Recti strip{scene.square.x0 - kStrip_px, 80, scene.square.x0, 160};
        Matte where(kDepartureFrame);
        for (int y = strip.y0; y < strip.y1; ++y)
            for (int x = strip.x0; x < strip.x1; ++x)
                where.at(x, y) = 255;
        if (confirmed) departure.correct(where, where);
        const ImageF1 before = scene.phi(kStrip_px);
        scene.step();
        return scene.advanced(departure, before).at(strip.x0 + 6, 120);
    };
    EXPECT_LT(odds_of(false), -2);
    EXPECT_GT(odds_of(true), -1.2f);
}

TEST(Departure, SpeaksAgainstWhatASurfaceHardlyDoesThoughItRestsOnItsBackground) {
    // An arm in front of a wall, and somebody beside it who moves likewise. Of the wall all is
    // seen, or little: what its motion is beside that which hides it is not known then.
    const auto odds_of_arm = [](int shown_to_y) {
        constexpr Recti kArm{150, 90, 158, 98}, kWallAndBeside{100, 60, 220, 180};
        const Recti wall{120, 80, 200, 160};
        const auto phi_to = [&](int y1) {
            Matte inside(kDepartureFrame);
            for (int y = wall.y0; y < y1; ++y)
                for (int x = wall.x0; x < wall.x1; ++x)
                    inside.at(x, y) = 1;
            return signed_distance(inside, 40);
        };
        ImageU8x3 before(kDepartureFrame), now(kDepartureFrame);
        FlowField rests(kDepartureFrame), flow(kDepartureFrame);
        const auto code = [](int x, int y) {
            return static_cast<std::uint8_t>(x * x * 7 + y * 53);
        };
        for (int y = 0; y < kDepartureFrame.height; ++y) {
            for (int x = 0; x < kDepartureFrame.width; ++x) {
                const bool small = !kWallAndBeside.contains(x, y) && x % 20 < 8 && y % 20 < 8;
                const bool moves = small || kArm.contains(x, y);
                rests.valid.row(y)[x] = flow.valid.row(y)[x] = 1;
                flow.d.pixel(x, y)[0] = moves ? -6.0f : 0.0f;
                before.pixel(x, y)[1] = code(x, y);
                now.pixel(x, y)[1] = code(moves ? x - 6 : x, y);
            }
        }
        const ImageF1 whole = phi_to(wall.y1), seen = phi_to(shown_to_y);
        const ImageF2 still(kDepartureFrame);
        const Recti all = rect_of(kDepartureFrame);
        Departure departure(whole);
        (void)departure.advance({whole, rests, still, before, before, all, 1});
        return departure.advance({seen, flow, still, now, before, all, 1}).at(154, 94);
    };
    EXPECT_LT(odds_of_arm(160), -0.2f);
    EXPECT_GT(odds_of_arm(105), -0.05f);
}

}  // namespace
}  // namespace weft

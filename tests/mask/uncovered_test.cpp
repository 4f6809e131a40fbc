// What comes into view from behind a surface that moves on.
#include "engine/mask/uncovered.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/mask/matte_propagation.h"
#include "engine/mask/signed_distance.h"
#include "tests/mask/moving_disc.h"

namespace weft {
namespace {

constexpr Size kUncoveredFrame{160, 120};
constexpr float kBand_px = 6;

ImageF2 constant(Vec2 d) {
    ImageF2 field(kUncoveredFrame);
    for (int y = 0; y < kUncoveredFrame.height; ++y)
        for (int x = 0; x < kUncoveredFrame.width; ++x)
            field.pixel(x, y)[0] = d.x, field.pixel(x, y)[1] = d.y;
    return field;
}

// A square that has moved to the right over a still background, and what it has uncovered.
struct Square {
    static constexpr int kLeft = 50, kTop = 40, kSide = 40, kStep = 6;
    const Recti before{kLeft, kTop, kLeft + kSide, kTop + kSide};
    const Recti now{kLeft + kStep, kTop, kLeft + kStep + kSide, kTop + kSide};
    FlowField flow{kUncoveredFrame};
    ImageF1 phi;

    Square() {
        Image<std::uint8_t, 1> inside(kUncoveredFrame);
        for (int y = 0; y < kUncoveredFrame.height; ++y) {
            for (int x = 0; x < kUncoveredFrame.width; ++x) {
                inside.at(x, y) = before.contains(x, y) ? 1 : 0;
                flow.d.at(x, y, 0) = now.contains(x, y) ? -kStep : 0;
                const bool uncovered = before.contains(x, y) && !now.contains(x, y);
                flow.valid.at(x, y) = uncovered ? 0 : 255;
            }
        }
        phi = signed_distance(inside, 4 * kBand_px);
    }
    // Of the surface, which may bend, this motion is known beside what was uncovered.
    [[nodiscard]] UncoveredParts parts(Uncovered& walk, Vec2 surface, const ImageF1& seen) const {
        return walk.advance({flow, phi, seen, constant(surface), constant(Vec2(0)),
                             rect_of(kUncoveredFrame), kBand_px});
    }
    [[nodiscard]] UncoveredParts parts(Vec2 surface) const {
        Uncovered walk;
        return parts(walk, surface, phi);
    }
};

constexpr Vec2i kGap(Square::kLeft + 2, Square::kTop + 20);
const Vec2 kWithTheSquare(-Square::kStep, 0);

int count(const Matte& pixels) {
    int n = 0;
    for (int y = 0; y < pixels.height(); ++y)
        for (int x = 0; x < pixels.width(); ++x)
            n += pixels.at(x, y) != 0 ? 1 : 0;
    return n;
}

TEST(Uncovered, AppearsBehindWhatHasMovedAndNowhereElse) {
    const UncoveredParts found = Square().parts(kWithTheSquare);
    EXPECT_EQ(found.appearing.at(kGap.x, kGap.y), 255);
    EXPECT_EQ(found.appearing.at(kGap.x + 20, kGap.y), 0);  // the square itself
    EXPECT_EQ(found.appearing.at(kGap.x - 20, kGap.y), 0);  // what was seen before
    EXPECT_EQ(found.appearing.at(Square::kLeft + Square::kSide + 20, kGap.y), 0);
    EXPECT_NEAR(count(found.appearing), Square::kStep * Square::kSide, 40);
}

// In the crook of an arm the part of the surface beside a gap stands still: by its motion, the gap
// was seen before, and it was not.
TEST(Uncovered, IsRevealedWhereTheSurfaceWouldHaveBeenSeen) {
    EXPECT_EQ(Square().parts(Vec2(0)).revealed.at(kGap.x, kGap.y), 255);
    EXPECT_EQ(count(Square().parts(kWithTheSquare).revealed), 0);
}

TEST(Uncovered, IsNotWhatSwingsOutFarFromTheSurface) {
    Square scene;
    for (int y = 40; y < 60; ++y) {  // unlike before, and its motion parts
        for (int x = 120; x < 132; ++x) {
            scene.flow.valid.at(x, y) = 0;
            scene.flow.d.at(x, y, 0) = static_cast<float>(126 - x);
        }
    }
    const UncoveredParts found = scene.parts(kWithTheSquare);
    EXPECT_EQ(found.appearing.at(126, 50), 0);
    EXPECT_EQ(found.appearing.at(kGap.x, kGap.y), 255);
}

TEST(Uncovered, IsNotWhatComesFromBehindAKnownOccluder) {
    const Square scene;
    ImageF1 seen = scene.phi;
    for (int y = 0; y < kUncoveredFrame.height; ++y)
        std::fill(seen.row(y), seen.row(y) + Square::kLeft + Square::kStep, 0.0f);
    Uncovered walk;
    const UncoveredParts found = scene.parts(walk, Vec2(0), seen);
    EXPECT_EQ(count(found.appearing), 0);
    EXPECT_EQ(count(found.revealed), 0);
}

// Blurred and striped surfaces look uncovered in their middle, too.
TEST(Uncovered, SaysNothingWhereFramesAreHardToCompare) {
    Square scene;
    Uncovered walk;
    EXPECT_GT(count(scene.parts(walk, Vec2(0), scene.phi).revealed), 0);
    Square hard;
    for (int y = 50; y < 60; ++y) {
        for (int x = 70; x < 80; ++x) {
            hard.flow.valid.at(x, y) = 0;
            hard.flow.d.at(x, y, 0) = static_cast<float>(75 - x - Square::kStep);
        }
    }
    EXPECT_EQ(count(hard.parts(walk, Vec2(0), hard.phi).revealed), 0);
    EXPECT_EQ(count(hard.parts(walk, Vec2(0), hard.phi).appearing), 0);
    // It takes a while until it is believed again.
    EXPECT_EQ(count(scene.parts(walk, Vec2(0), scene.phi).revealed), 0);
    for (int frame = 0; frame < 12; ++frame)
        static_cast<void>(scene.parts(walk, Vec2(0), scene.phi));
    EXPECT_GT(count(scene.parts(walk, Vec2(0), scene.phi).revealed), 0);
}

// A sleeve whose forearm sinks away from something that it had hidden altogether, and that no other
// place shows.
struct Sleeve {
    static constexpr int kStep = 3;
    static constexpr Recti kUpperArm{30, 10, 56, 60};
    static constexpr Recti kBehind{56, 58, 138, 80};
    [[nodiscard]] static Recti forearm(int t) { return {30, 56 + kStep * t, 140, 82 + kStep * t}; }
    [[nodiscard]] static bool inside(int x, int y, int t) {
        const Recti arm{kUpperArm.x0, kUpperArm.y0, kUpperArm.x1, forearm(t).y0};
        return arm.contains(x, y) || forearm(t).contains(x, y);
    }
    [[nodiscard]] static float cloth(int x, int y) {
        return 24 * std::sin(0.7f * static_cast<float>(x)) * std::sin(0.5f * static_cast<float>(y));
    }
    [[nodiscard]] static Matte matte(int t) {
        Matte m(kUncoveredFrame);
        for (int y = 0; y < kUncoveredFrame.height; ++y)
            for (int x = 0; x < kUncoveredFrame.width; ++x)
                m.at(x, y) = inside(x, y, t) ? 255 : 0;
        return m;
    }
    [[nodiscard]] static ImageU8x3 frame(int t) {
        const Vec3 sleeve(170, 110, 80), behind(130, 170, 90), wall(70, 110, 140);
        ImageU8x3 f(kUncoveredFrame);
        for (int y = 0; y < kUncoveredFrame.height; ++y) {
            for (int x = 0; x < kUncoveredFrame.width; ++x) {
                const bool arm = forearm(t).contains(x, y);
                const float wave = cloth(x, y - (arm ? kStep * t : 0));
                const Vec3& paint = inside(x, y, t)          ? sleeve
                                    : kBehind.contains(x, y) ? behind
                                                             : wall;
                for (int c = 0; c < 3; ++c)
                    f.at(x, y, c) = static_cast<std::uint8_t>(paint[c] + wave);
            }
        }
        return f;
    }
    [[nodiscard]] static FlowField motion(int t) {
        FlowField f(kUncoveredFrame);
        for (int y = 0; y < kUncoveredFrame.height; ++y) {
            for (int x = 0; x < kUncoveredFrame.width; ++x) {
                if (forearm(t).contains(x, y))
                    f.d.at(x, y, 1) = -kStep;
                else if (forearm(t - 1).contains(x, y))
                    f.valid.at(x, y) = 0;
            }
        }
        return f;
    }
};

TEST(Uncovered, ASleeveDoesNotTakeWhatItHadHidden) {
    MatteWalker walker(Sleeve::frame(0), Sleeve::matte(0), {});
    for (int t = 1; t <= 9; ++t) {
        const Matte found = walker.advance(Sleeve::frame(t), Sleeve::motion(t)).matte;
        EXPECT_GT(test::overlap(found, Sleeve::matte(t)), 0.95) << "frame " << t;
    }
}

}  // namespace
}  // namespace weft

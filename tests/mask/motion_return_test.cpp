// A figure that bends, is lost, and comes back elsewhere.
#include "engine/mask/motion_return.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/mask/part_return.h"
#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr Size kFigureFrame{320, 200};

// A red figure of 40×60 px on grey, whose motion departs from the background's where `moves`.
struct FigureScene {
    ImageU8x3 frame{kFigureFrame};
    ImageF1 departs{kFigureFrame};
    FlowField flow{kFigureFrame};

    FigureScene(const Recti& figure, bool moves) {
        for (int y = 0; y < kFigureFrame.height; ++y) {
            for (int x = 0; x < kFigureFrame.width; ++x) {
                const bool inside = figure.contains(x, y);
                frame.pixel(x, y)[0] = inside ? 200 : 120;
                frame.pixel(x, y)[1] = frame.pixel(x, y)[2] = inside ? 30 : 120;
                departs.at(x, y) = !moves ? 0.0f : inside ? 2.0f : -2.0f;
                flow.d.pixel(x, y)[0] = inside ? -4.0f : 0.0f;
                flow.d.pixel(x, y)[1] = 0;
            }
        }
    }
};

constexpr Recti kKey{40, 60, 80, 120};
Recti at(int t) {
    return {kKey.x0 + 100 + 4 * t, kKey.y0, kKey.x1 + 100 + 4 * t, kKey.y1};
}

ImageF1 figure_distance(const Recti& figure) {
    Matte inside(kFigureFrame);
    for (int y = figure.y0; y < figure.y1; ++y)
        for (int x = figure.x0; x < figure.x1; ++x)
            inside.at(x, y) = 1;
    return signed_distance(inside, 40);
}

double overlap_of(const Matte& found, const Recti& figure) {
    double both = 0, either = 0;
    for (int y = 0; y < found.height(); ++y) {
        for (int x = 0; x < found.width(); ++x) {
            both += found.at(x, y) != 0 && figure.contains(x, y);
            either += found.at(x, y) != 0 || figure.contains(x, y);
        }
    }
    return both / either;
}

// What returns on four frames after the figure was lost.
std::vector<Matte> returned(MotionReturn& back, bool moves, const ImageF1& seen) {
    const SurfacePalette palette(FigureScene(kKey, true).frame, figure_distance(kKey));
    std::vector<Matte> out;
    for (int t = 0; t < 4; ++t) {
        const FigureScene scene(at(t), moves);
        out.push_back(back.returned({scene.frame, seen, scene.flow, scene.departs, palette, 1}));
    }
    return out;
}

TEST(MotionReturn, FindsTheWholeOnceItHasBeenThereForThreeFrames) {
    const ImageF1 nothing(kFigureFrame, -40);
    MotionReturn back(figure_distance(kKey));
    EXPECT_TRUE(back.lost(nothing));
    const std::vector<Matte> found = returned(back, true, nothing);
    EXPECT_TRUE(found[0].empty());
    EXPECT_TRUE(found[1].empty());
    ASSERT_FALSE(found[2].empty());
    EXPECT_GT(overlap_of(found[2], at(2)), 0.75);
    // The middle of the figure is the middle of the painted one.
    const Vec2 place = back.key_place(at(2).x0 + 20, at(2).y0 + 30);
    EXPECT_NEAR(place.x, kKey.x0 + 20, 2);
    EXPECT_NEAR(place.y, kKey.y0 + 30, 2);
}

TEST(MotionReturn, LeavesASurfaceAloneThatIsSeen) {
    MotionReturn back(figure_distance(kKey));
    EXPECT_FALSE(back.lost(figure_distance(kKey)));
    for (const Matte& matte : returned(back, true, figure_distance(kKey)))
        EXPECT_TRUE(matte.empty());
}

TEST(MotionReturn, DoesNotTakeAnotherThingOfItsColour) {
    // A far larger one, and two between which nothing decides.
    const ImageF1 nothing(kFigureFrame, -40);
    const SurfacePalette palette(FigureScene(kKey, true).frame, figure_distance(kKey));
    MotionReturn large(figure_distance(kKey)), twice(figure_distance(kKey));
    for (int t = 0; t < 5; ++t) {
        const FigureScene wide({20, 10, 300, 190}, true);
        EXPECT_TRUE(
            large.returned({wide.frame, nothing, wide.flow, wide.departs, palette, 1}).empty());
        FigureScene two({40, 60, 80, 120}, true);
        const FigureScene other({200, 60, 240, 120}, true);
        for (int y = 60; y < 120; ++y) {
            for (int x = 200; x < 240; ++x) {
                std::copy_n(other.frame.pixel(x, y), 3, two.frame.pixel(x, y));
                two.departs.at(x, y) = 2;
            }
        }
        EXPECT_TRUE(
            twice.returned({two.frame, nothing, two.flow, two.departs, palette, 1}).empty());
    }
}

// What returns on four frames on which only the upper part of the figure is seen.
std::vector<Matte> returned_around(const Recti& seen, double share, const Recti& moving) {
    const SurfacePalette palette(FigureScene(kKey, true).frame, figure_distance(kKey));
    PartReturn back(figure_distance(kKey));
    Recti part = seen;
    part.y1 = part.y0 + static_cast<int>(share * (seen.y1 - seen.y0));
    std::vector<Matte> out;
    for (int t = 0; t < 4; ++t) {
        const FigureScene scene(moving, true);
        out.push_back(back.returned(
            {scene.frame, figure_distance(part), scene.flow, scene.departs, palette, 1}));
    }
    return out;
}

TEST(PartReturn, AddsTheRestOnceItHasBeenThereForThreeFrames) {
    const std::vector<Matte> found = returned_around(at(0), 0.4, at(0));
    EXPECT_TRUE(found[0].empty());
    EXPECT_TRUE(found[1].empty());
    ASSERT_FALSE(found[2].empty());
    EXPECT_GT(overlap_of(found[2], at(0)), 0.75);
}

TEST(PartReturn, LeavesAloneWhatIsSeenOrLost) {
    for (const double share : {0.8, 0.05}) {
        for (const Matte& matte : returned_around(at(0), share, at(0)))
            EXPECT_TRUE(matte.empty()) << share;
    }
}

TEST(PartReturn, TakesNothingLargerThanTheSurfaceWas) {
    for (const Matte& matte : returned_around(at(0), 0.4, {100, 10, 300, 190}))
        EXPECT_TRUE(matte.empty());
}

TEST(PartReturn, WhatHasLeftThePictureIsNotLost) {
    const Recti border{kFigureFrame.width - 40, 60, kFigureFrame.width, 120};
    for (const Matte& matte : returned_around(border, 0.4, border))
        EXPECT_TRUE(matte.empty());
}

}  // namespace
}  // namespace weft

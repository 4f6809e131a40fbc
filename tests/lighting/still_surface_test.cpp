// Gloss, told from paint by what moves over the surface.
#include "engine/lighting/still_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "engine/core/luma.h"
#include "engine/core/rng.h"

namespace weft {
namespace {

constexpr int kSide = 96, kFrames = 12, kStep_px = 3;
constexpr Vec2i kStart{12, 48};

// Grey bricks of several tones.
float paint_at(int x, int y) {
    return ((x / 8 + 3 * (y / 6)) % 4) * 0.08f + 0.12f;
}

float spot(int x, int y, Vec2i at, float width) {
    const float u = static_cast<float>(x - at.x) / width, v = static_cast<float>(y - at.y) / width;
    return std::exp(-u * u - v * v);
}

// What is seen at a place of the surface on a frame, given its paint.
using Seen = std::function<float(float paint, int x, int y, int frame)>;

ImageF3 plate_of(const Seen& seen, int frame) {
    ImageF3 plate(kSide, kSide);
    Rng rng(static_cast<std::uint64_t>(7 + frame));
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            for (int c = 0; c < 3; ++c)
                plate.pixel(x, y)[c] =
                    seen(paint_at(x, y), x, y, frame) + 0.002f * static_cast<float>(rng.uniform());
    return plate;
}

Vec2i passing(int frame) {
    return {kStart.x + 2 * kStep_px * frame, kStart.y};
}

float with_highlight(float paint, int x, int y, int frame) {
    return paint + 0.4f * spot(x, y, passing(frame), 9);
}

float with_shadow(float paint, int x, int y, int frame) {
    return paint * (1 - 0.7f * spot(x, y, passing(frame), 9));
}

// The surface stands still in the picture, and what passes moves.
const LatticeField kStill(Size{kSide, kSide}, 8);
const Matte kAll(Size{kSide, kSide}, 255);

StillSurface found(const Seen& seen) {
    StillSurfaceGatherer gatherer(2);
    for (int frame = 0; frame < kFrames; ++frame)
        gatherer.add(plate_of(seen, frame), kAll, kStill);
    return gatherer.finish(0);
}

double correlation(const ImageF1& a, const std::function<float(int x, int y)>& b) {
    double n = 0, sa = 0, sb = 0, aa = 0, bb = 0, ab = 0;
    for (int y = 4; y < kSide - 4; ++y) {
        for (int x = 4; x < kSide - 4; ++x) {
            const double u = a.row(y)[x], v = b(x, y);
            n += 1, sa += u, sb += v, aa += u * u, bb += v * v, ab += u * v;
        }
    }
    return (n * ab - sa * sb) / std::sqrt((n * aa - sa * sa) * (n * bb - sb * sb));
}

TEST(StillSurface, IsWhatAHighlightPassesOver) {
    const StillSurface still = found(with_highlight);
    EXPECT_GT(still.confidence, 0.9f);
    const int frame = 6;
    const ImageF1 gloss =
        moving_gloss({0, 0}, plate_of(with_highlight, frame), kAll, still, kStill);
    EXPECT_GT(correlation(gloss, [&](int x, int y) { return spot(x, y, passing(frame), 9); }),
              0.98);
    EXPECT_NEAR(gloss.at(passing(frame).x, passing(frame).y), 0.4f, 0.05f);
    EXPECT_LT(gloss.at(8, 8), 0.02f);
}

TEST(StillSurface, IsNotTrustedUnderAMovingShadow) {
    EXPECT_EQ(found(with_shadow).confidence, 0);
}

TEST(StillSurface, IsNotTrustedWhereNothingMoves) {
    EXPECT_LT(found([](float paint, int, int, int) { return paint; }).confidence, 0.01f);
}

TEST(StillSurface, IsNotTrustedUnderAPatchOfSunThatMultipliesThePaint) {
    const auto sunlit = [](float paint, int x, int y, int frame) {
        return paint * (1 + 2 * spot(x, y, passing(frame), 9));
    };
    EXPECT_LT(found(sunlit).confidence, 0.01f);
}

// A plain surface does not tell light from gloss.
TEST(StillSurface, IsNotTrustedOnAPlainSurfaceUnderSunAndSky) {
    StillSurfaceGatherer plain(2), under_sky(2);
    const auto seen = [](float, int x, int y, int frame) {
        return with_highlight(0.2f, x, y, frame);
    };
    for (StillSurfaceGatherer* gatherer : {&plain, &under_sky})
        for (int frame = 0; frame < kFrames; ++frame)
            gatherer->add(plate_of(seen, frame), kAll, kStill);
    EXPECT_GT(plain.finish(0).confidence, 0.9f);
    EXPECT_EQ(under_sky.finish(1).confidence, 0);
}

TEST(StillSurface, FollowsTheWholeFramesLight) {
    const auto dimming = [](float paint, int x, int y, int frame) {
        return with_highlight(paint, x, y, frame) * (1 - 0.04f * static_cast<float>(frame));
    };
    const StillSurface still = found(dimming);
    const ImageF1 gloss = moving_gloss({0, 0}, plate_of(dimming, 11), kAll, still, kStill);
    EXPECT_LT(gloss.at(8, 8), 0.02f);
}

TEST(StillSurface, OfFewFramesIsEmpty) {
    StillSurfaceGatherer gatherer(2);
    for (int frame = 0; frame < 3; ++frame)
        gatherer.add(plate_of(with_highlight, frame), kAll, kStill);
    const StillSurface still = gatherer.finish(0);
    EXPECT_TRUE(still.box.empty());
    const ImageF1 none = moving_gloss({0, 0}, plate_of(with_highlight, 0), kAll, still, kStill);
    EXPECT_EQ(none.size(), kAll.size());
    EXPECT_EQ(none.at(passing(0).x, passing(0).y), 0);
}

TEST(StillSurface, OfAPartIsThatOfTheWhole) {
    const StillSurface still = found(with_highlight);
    const ImageF3 plate = plate_of(with_highlight, 6);
    const Recti box{10, 20, 80, 70};
    const ImageF1 whole = moving_gloss({0, 0}, plate, kAll, still, kStill);
    const ImageF1 part = moving_gloss({box.x0, box.y0}, plate.view().crop(box),
                                      kAll.view().crop(box), still, kStill);
    EXPECT_NEAR(part.at(passing(6).x - box.x0, passing(6).y - box.y0),
                whole.at(passing(6).x, passing(6).y), 0.02f);
}

}  // namespace
}  // namespace weft

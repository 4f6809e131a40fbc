// Measurements of the strips below the ruler on pictures with known answers.
#include "app/preview/preview_flicker.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

constexpr Size kSize{200, 120};

// A pattern of waves, further right by `dx`, and brighter by `lift`.
ImageF3 waves(int dx, float lift = 0) {
    ImageF3 out(kSize);
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x)
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = 0.5f + lift +
                                  0.2f * std::sin(0.31f * static_cast<float>(x - dx)) *
                                      std::cos(0.23f * static_cast<float>(y));
    return out;
}

Matte box(int dx) {
    Matte out(kSize, 0);
    for (int y = 30; y < 90; ++y)
        for (int x = 60 + dx; x < 140 + dx; ++x)
            out.at(x, y) = 255;
    return out;
}

FramePair steady_pair() {
    FramePair pair;
    pair.before = {waves(0), waves(0), box(0), nullptr};
    pair.now = {waves(2), waves(2), box(2), nullptr};
    return pair;
}

TEST(PreviewFlicker, ATextureThatMovesWithThePlateIsStable) {
    const Steadiness found = measure_steadiness(steady_pair());
    EXPECT_GE(found.flicker, 0);
    EXPECT_LT(found.flicker, 1);
    EXPECT_NEAR(found.flicker, found.flicker_plate, 1e-6);
    EXPECT_LT(found.chatter, 0.15f);
    EXPECT_LT(found.seam_motion, 0);
}

TEST(PreviewFlicker, AFlashIsMeasuredInLevelsAndThePlateIsNot) {
    FramePair pair = steady_pair();
    pair.now.result = waves(2, 10.0f / 255);
    const Steadiness found = measure_steadiness(pair);
    EXPECT_NEAR(found.flicker, 10, 0.5f);
    EXPECT_LT(found.flicker_plate, 1);
}

TEST(PreviewFlicker, MotionErrorIsNotCountedAsFlicker) {
    FramePair pair = steady_pair();
    // The plate moves by two pixels and the texture by three: along the plate's motion the texture
    // changes.
    pair.now.result = waves(3);
    EXPECT_LT(measure_steadiness(pair).flicker_floor, 0);
    pair.before_from_now = FlowField(kSize);
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x)
            pair.before_from_now.d.at(x, y, 0) = -3;
    const Steadiness carried = measure_steadiness(pair);
    EXPECT_GT(carried.flicker, 5);
    EXPECT_NEAR(carried.flicker_floor, carried.flicker, 0.2f);
    // A flash is not explained by motion.
    pair.now.result = waves(3, 30.0f / 255);
    const Steadiness flash = measure_steadiness(pair);
    EXPECT_NEAR(flash.flicker_floor, carried.flicker_floor, 1e-4f);
    EXPECT_GT(flash.flicker, flash.flicker_floor + 15);
}

TEST(PreviewFlicker, ChatterAndCrawlingSeamsAreInPlatePixels) {
    FramePair pair = steady_pair();
    pair.now.matte = box(6);
    pair.plate_scale = 4;
    pair.seam_scale = 2;
    SeamPoints before, now;
    // A seam across, at twice the pictures' size, which sinks by six of its pixels.
    for (int x = 130; x < 260; ++x) {
        before.push_back({static_cast<std::uint16_t>(x), 100});
        now.push_back({static_cast<std::uint16_t>(x + 4), 106});
    }
    pair.before.seams = std::make_shared<const SeamPoints>(before);
    pair.now.seams = std::make_shared<const SeamPoints>(now);
    const Steadiness found = measure_steadiness(pair);
    // Four pixels on two sides of a box of 80 × 60, four plate pixels each.
    EXPECT_NEAR(found.chatter, 4.0f * 4 * 60 / 140, 1.2f);
    EXPECT_NEAR(found.seam_motion, 6 * 4 / 2, 0.5f);
    // Moved along with it, the seams stay on the texture.
    pair.now.matte = pair.before.matte = Matte(kSize, 255);
    pair.before_from_now = FlowField(kSize);
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x) {
            pair.before_from_now.d.at(x, y, 0) = -2;
            pair.before_from_now.d.at(x, y, 1) = -3;
        }
    EXPECT_EQ(measure_steadiness(pair).seam_motion, 0);
}

TEST(PreviewFlicker, SeamsThatStickHaveNoMotionOfTheirOwn) {
    FlowField motion(kSize);
    SeamPoints before, now;
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x)
            motion.d.at(x, y, 0) = 3;
        before.push_back({50, static_cast<std::uint16_t>(y)});
        now.push_back({53, static_cast<std::uint16_t>(y)});
    }
    EXPECT_EQ(seam_motion_px(before, now, motion, 1), 0);
    EXPECT_LT(seam_motion_px(before, {}, motion, 1), 0);
    motion.valid = Matte(kSize, 0);
    EXPECT_LT(seam_motion_px(before, now, motion, 1), 0);
}

}  // namespace
}  // namespace weft

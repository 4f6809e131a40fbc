#include "engine/metrics/tde.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/metrics/synthetic.h"

namespace weft {
namespace {

using synthetic::constant_motion;
using synthetic::waves;

constexpr Size kWavesSize{96, 80};

TEST(Tde, IsTheResamplingErrorAloneForAPictureMovedExactly) {
    const ImageF1 earlier = waves(kWavesSize, 12, 60);
    const ImageF1 later = waves(kWavesSize, 12, 60, 2.5, -1.25);
    const Matte all(kWavesSize, 255);
    const FlowField forward = constant_motion(kWavesSize, 2.5f, -1.25f);
    const TemporalError moving =
        measure_tde(earlier, later, forward, visible_in_both(forward, all, all));
    EXPECT_LT(moving.tde, 0.6);
    EXPECT_GT(moving.pixels, 80 * 60);
    const FlowField backward = constant_motion(kWavesSize, -2.5f, 1.25f);
    const TemporalError back =
        measure_tde(later, earlier, backward, visible_in_both(backward, all, all));
    EXPECT_LT(back.tde, 0.6);
    // The same texture left where it was: two waves 2.5 and 1.25 px out of phase differ by
    // 0.5 · 60 · (2 sin(π 2.5/12) |cos| + …), far above the resampling error.
    const TemporalError still =
        measure_tde(earlier, earlier, forward, visible_in_both(forward, all, all));
    EXPECT_GT(still.tde, 20);
}

TEST(Tde, CountsAFlickerInFullLevels) {
    const ImageF1 earlier = waves(kWavesSize, 12, 60);
    ImageF1 later = earlier;
    for (int y = 0; y < kWavesSize.height; ++y) {
        for (int x = 0; x < kWavesSize.width; ++x)
            later.at(x, y) += x % 2 == 0 ? 8.0f : -4.0f;
    }
    const Matte all(kWavesSize, 255);
    const FlowField none(kWavesSize);
    const TemporalError e = measure_tde(earlier, later, none, visible_in_both(none, all, all));
    EXPECT_NEAR(e.tde, 6.0, 1e-4);
    EXPECT_EQ(e.pixels, 96 * 80);
}

TEST(Tde, LooksOnlyAtWhatIsSeenInBothFrames) {
    const Matte region = synthetic::rectangle(kWavesSize, {20, 20, 60, 60});
    const Matte half = synthetic::rectangle(kWavesSize, {20, 20, 40, 60});
    FlowField f = constant_motion(kWavesSize, 0, 0);
    // 20 × 40 seen in both, eroded by 2 px on all sides.
    EXPECT_EQ(measure_tde(waves(kWavesSize, 9, 9), waves(kWavesSize, 9, 9), f,
                          visible_in_both(f, region, half))
                  .pixels,
              16 * 36);
    f.valid.at(30, 30) = 0;
    EXPECT_EQ(visible_in_both(f, region, half).at(30, 30), 0);
    EXPECT_EQ(visible_in_both(f, region, half).at(31, 30), 255);
    // What leaves the picture is not seen again.
    const Matte all(kWavesSize, 255);
    const FlowField away = constant_motion(kWavesSize, 10, 0);
    const Matte visible = visible_in_both(away, all, all);
    EXPECT_EQ(visible.at(85, 40), 255);
    EXPECT_EQ(visible.at(86, 40), 0);
}

TEST(Tde, LeavesOutWhatIsNotANumber) {
    ImageF1 earlier(kWavesSize, 100.0f);
    const ImageF1 later(kWavesSize, 103.0f);
    earlier.at(50, 40) = std::numeric_limits<float>::quiet_NaN();
    const Matte all(kWavesSize, 255);
    const FlowField none(kWavesSize);
    const TemporalError e = measure_tde(earlier, later, none, visible_in_both(none, all, all));
    EXPECT_NEAR(e.tde, 3.0, 1e-4);
    EXPECT_EQ(e.pixels, 96 * 80 - 1);
}

TEST(Moved, CarriesAPictureByTheField) {
    const ImageF1 picture = waves(kWavesSize, 16, 50);
    const ImageF1 out = moved(picture, constant_motion(kWavesSize, -3, 2));
    EXPECT_NEAR(out.at(40, 30), picture.at(37, 32), 1e-3);
    EXPECT_EQ(out.at(2, 30), 0);  // Comes from beyond the picture.
}

}  // namespace
}  // namespace weft

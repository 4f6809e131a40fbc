#include "engine/metrics/likeness.h"

#include <gtest/gtest.h>

#include "tests/metrics/synthetic.h"

namespace weft {
namespace {

using synthetic::kSlidSize;

ImageF3 slid_picture(float dx) {
    return synthetic::grey(synthetic::slid_texture(dx, 0));
}

// Whole from x = 40 to 160, with an edge of half coverage four pixels wide on the left.
Matte strip() {
    Matte matte(kSlidSize);
    for (int y = 0; y < kSlidSize.height; ++y) {
        for (int x = 36; x < 160; ++x)
            matte.at(x, y) = x < 40 ? 128 : 255;
    }
    return matte;
}

void brighten(ImageF3& picture, int x0, int x1, float by) {
    for (int y = 0; y < kSlidSize.height; ++y) {
        for (int x = x0; x < x1; ++x) {
            for (int c = 0; c < 3; ++c)
                picture.at(x, y, c) += by;
        }
    }
}

TEST(Likeness, ThePlaceOfFeatures) {
    SequenceLikeness all;
    const FrameLikeness same = all.add(1, slid_picture(0), slid_picture(0), strip());
    EXPECT_LT(same.features.mean_px, 1e-6);
    EXPECT_EQ(same.interior, 0);
    const FrameLikeness off = all.add(2, slid_picture(0), slid_picture(1.25f), strip());
    EXPECT_NEAR(off.features.mean_px, 1.25, 0.03);
    EXPECT_GT(off.interior, 1);
    EXPECT_NEAR(all.summary().largest_offset_px, off.features.mean_px, 1e-9);
}

TEST(Likeness, PartsAreToldApart) {
    SequenceLikeness all;
    ImageF3 wrong = slid_picture(0);
    brighten(wrong, 0, 36, 3 / 255.0f);
    brighten(wrong, 36, 40, 20 / 255.0f);
    brighten(wrong, 40, 200, 1 / 255.0f);
    const FrameLikeness f = all.add(7, slid_picture(0), wrong, strip());
    EXPECT_EQ(f.frame, 7);
    EXPECT_NEAR(f.interior, 1, 1e-3);
    EXPECT_NEAR(f.soft_edge, 20, 1e-3);
    EXPECT_NEAR(f.outside, (36.0 * 3 + 40.0) / 76, 1e-3);
    EXPECT_LT(f.soft_edge_change, 0) << "the first frame has none before it";
}

TEST(Likeness, AnEdgeThatIsWrongTheSameWayDoesNotBoil) {
    SequenceLikeness all;
    ImageF3 wrong = slid_picture(0);
    brighten(wrong, 36, 40, 20 / 255.0f);
    all.add(1, slid_picture(0), wrong, strip());
    EXPECT_NEAR(all.add(2, slid_picture(0), wrong, strip()).soft_edge_change, 0, 1e-4);
    brighten(wrong, 36, 40, -40 / 255.0f);
    EXPECT_NEAR(all.add(3, slid_picture(0), wrong, strip()).soft_edge_change, 40, 1e-3);
}

TEST(Likeness, TheWorstCropsComeFirstOnePerFrame) {
    SequenceLikeness all(2);
    for (const int level : {4, 9, 1}) {
        ImageF3 wrong = slid_picture(0);
        brighten(wrong, 100, 200, static_cast<float>(level) / 255.0f);
        all.add(level, slid_picture(0), wrong, strip());
    }
    ASSERT_EQ(all.worst().size(), 2u);
    EXPECT_EQ(all.worst()[0].frame, 9);
    EXPECT_EQ(all.worst()[1].frame, 4);
    EXPECT_EQ(all.worst()[0].box.x0, 96) << "the window that shows most of it";
    const ImageU8x3 strip = strip_of(all.worst());
    EXPECT_EQ(strip.width(), 2 * 96 + 2);
    EXPECT_EQ(strip.height(), 3 * 96 + 4);
    EXPECT_EQ(strip.at(10, 2 * 98 + 10, 0), 128 + 4 * 9);
}

}  // namespace
}  // namespace weft

// The strip of seams shows what an eye would see.
#include "engine/metrics/seam_visibility.h"

#include <gtest/gtest.h>

#include <functional>

namespace weft {
namespace {

constexpr Size kSize{256, 192};

ImageF3 seamed_picture(const std::function<float(int, int)>& grey) {
    ImageF3 out(kSize.width, kSize.height);
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x)
            for (int k = 0; k < 3; ++k)
                out.pixel(x, y)[k] = grey(x, y);
    return out;
}

// Tiles of 24 px with light joints of 3 px.
float tiles(int x, int y) {
    return x % 24 < 3 || y % 24 < 3 ? 0.8f
                                    : 0.35f + 0.01f * static_cast<float>((x * 7 + y * 5) % 3);
}

float share(const ImageF3& pixels, const std::function<bool(int, int)>& is_seam) {
    ImageF1 seam(kSize.width, kSize.height, 0.0f);
    Matte touched(kSize);
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x) {
            seam.at(x, y) = is_seam(x, y) ? 1.0f : 0.0f;
            touched.at(x, y) = 255;
        }
    return seam_visibility(pixels, touched, seam);
}

TEST(SeamVisibility, SeamsAlongTheJointsOfTilesAreNotSeen) {
    const float along = share(seamed_picture(tiles), [](int x, int y) {
        return x % 96 == 2 || y % 96 == 2;  // the edge of every fourth joint
    });
    EXPECT_GE(along, 0);
    EXPECT_LT(along, 0.03f);
    // Such a seam is many times as steep as the tiles are in the mean, which was what was shown.
    const float across = share(seamed_picture(tiles), [](int x, int) { return x % 96 == 12; });
    EXPECT_LT(across, 0.03f);
}

TEST(SeamVisibility, AStepOnAPlainWallIsSeen) {
    const auto wall = [](int x, int) { return x < 128 ? 0.5f : 0.56f; };
    const float step = share(seamed_picture(wall), [](int x, int) { return x == 127; });
    EXPECT_GT(step, 0.95f);
    const auto faint = [](int x, int) { return x < 128 ? 0.5f : 0.505f; };
    EXPECT_LT(share(seamed_picture(faint), [](int x, int) { return x == 127; }), 0.01f)
        << "below what is noticed";
}

TEST(SeamVisibility, HalfOfASeamCountsHalf) {
    const auto wall = [](int x, int y) { return x < 128 || y < 96 ? 0.5f : 0.6f; };
    EXPECT_NEAR(share(seamed_picture(wall), [](int x, int) { return x == 127; }), 0.5f, 0.05f);
}

TEST(SeamVisibility, WithoutSeamsOrTextureNothingIsSaid) {
    EXPECT_LT(share(seamed_picture(tiles), [](int, int) { return false; }), 0);
    EXPECT_LT(share(seamed_picture(tiles), [](int, int) { return true; }), 0);
}

}  // namespace
}  // namespace weft

// Blur that varies over a picture.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/composite/focus_map.h"

namespace weft {
namespace {

constexpr Size kBoardSize{384, 256};

// Tiles of two greys, 16 px wide, so that there are edges everywhere.
ImageF3 board() {
    ImageF3 out(kBoardSize);
    for (int y = 0; y < kBoardSize.height; ++y) {
        for (int x = 0; x < kBoardSize.width; ++x) {
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = ((x / 16 + y / 16) % 2) != 0 ? 0.7f : 0.1f;
        }
    }
    return out;
}

// The blur of a lens: in focus in the middle of the picture's width.
float true_blur(int x) {
    const float u = (static_cast<float>(x) - 192.0f) / 192.0f;
    return std::sqrt(0.6f * 0.6f + 9.0f * u * u);
}

ImageF1 blur_map() {
    ImageF1 out(kBoardSize);
    for (int y = 0; y < kBoardSize.height; ++y) {
        for (int x = 0; x < kBoardSize.width; ++x)
            out.at(x, y) = true_blur(x);
    }
    return out;
}

TEST(BlurByMap, BlursEachPlaceAsAskedFor) {
    const Matte all(kBoardSize, 255);
    ImageF3 picture = board();
    blur_by_map(picture, all, blur_map());
    for (const int x : {20, 90, 192, 300, 350}) {
        std::vector<EdgeBlur> near;
        for (const EdgeBlur& e : edge_blurs(picture, all, 0.01f)) {
            if (std::abs(e.x - x) < 12) near.push_back(e);
        }
        EXPECT_NEAR(sharper_blur_px(near), true_blur(x), 0.25f + 0.12f * true_blur(x)) << x;
    }
}

TEST(BlurByMap, NothingIsBlurredWhereTheMapIs0) {
    ImageF3 picture = board();
    const ImageF3 before = picture;
    ImageF1 map(kBoardSize);
    for (int x = 200; x < kBoardSize.width; ++x)
        map.at(x, 100) = 2;
    blur_by_map(picture, Matte(kBoardSize, 255), map);
    for (int x = 0; x < kBoardSize.width; ++x) {
        EXPECT_EQ(picture.at(x, 99, 0), before.at(x, 99, 0));
        EXPECT_EQ(picture.at(x, 101, 2), before.at(x, 101, 2));
    }
}

TEST(FitFocus, FindsTheLensFromThePictureAndItsDepth) {
    const Matte all(kBoardSize, 255);
    ImageF3 picture = board();
    blur_by_map(picture, all, blur_map());
    // Nearness grows along the picture, in any unit.
    ImageF1 nearness(kBoardSize);
    for (int y = 0; y < kBoardSize.height; ++y) {
        for (int x = 0; x < kBoardSize.width; ++x)
            nearness.at(x, y) = 0.01f + 0.0001f * static_cast<float>(x);
    }
    const auto lens = fit_focus(edge_blurs(picture, all, 0.01f), nearness);
    ASSERT_TRUE(lens);
    for (const int x : {30, 100, 192, 280, 350}) {
        EXPECT_NEAR(lens->blur_px(nearness.at(x, 0)), true_blur(x), 0.25f + 0.2f * true_blur(x))
            << x;
    }
    EXPECT_FALSE(fit_focus(edge_blurs(picture, all, 0.01f), ImageF1(kBoardSize, 1.0f)));
}

TEST(SlopingBlur, FindsASlopeAndLeavesAnEvenPictureAlone) {
    const Matte all(kBoardSize, 255);
    ImageF1 slope(kBoardSize), even(kBoardSize, 1.5f);
    for (int y = 0; y < kBoardSize.height; ++y) {
        for (int x = 0; x < kBoardSize.width; ++x)
            slope.at(x, y) = 0.8f + 2.2f * static_cast<float>(y) / kBoardSize.height;
    }
    ImageF3 picture = board();
    blur_by_map(picture, all, slope);
    const BlurSlope found = blur_slope(edge_blurs(picture, all, 0.01f), kBoardSize);
    EXPECT_EQ(found.agreement, 1);
    EXPECT_NEAR(std::sqrt(found.variance(200.5f, 230.5f)), slope.at(200, 230), 0.7f);
    EXPECT_NEAR(std::sqrt(found.variance(200.5f, 40.5f)), slope.at(200, 40), 0.5f);
    picture = board();
    blur_by_map(picture, all, even);
    EXPECT_EQ(blur_slope(edge_blurs(picture, all, 0.01f), kBoardSize).agreement, 0);
}

}  // namespace
}  // namespace weft

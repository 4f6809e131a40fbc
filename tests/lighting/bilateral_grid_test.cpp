// Filtering along the edges of a guide.
#include "engine/lighting/bilateral_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

constexpr Size kPicture{60, 40};
constexpr int kStepAt = 30;

// A step of 1 under a ripple of 0.05.
ImageF1 rippled_step() {
    ImageF1 out(kPicture);
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            out.at(x, y) = (x < kStepAt ? 0.0f : 1.0f) + ((x + y) % 2 ? 0.05f : -0.05f);
    return out;
}

TEST(BilateralGrid, KeepsStepsAndNotRipplesAtAnyScale) {
    const ImageF1 picture = rippled_step(), all(kPicture, 1.0f);
    for (const float space_px : {0.5f, 1.0f, 1.4f, 1.6f, 4.0f}) {
        const ImageF1 out = joint_bilateral(picture, all, picture, {space_px, 0.3f});
        for (int y = 5; y < out.height() - 5; ++y) {
            EXPECT_NEAR(out.at(kStepAt - 1, y), 0, 0.04f) << space_px;
            EXPECT_NEAR(out.at(kStepAt, y), 1, 0.04f) << space_px;
        }
    }
}

// The two ways of computing it meet.
TEST(BilateralGrid, IsTheSameBySumsAndByTheGrid) {
    ImageF1 picture = rippled_step(), weight(kPicture, 1.0f);
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            weight.at(x, y) = x % 7 == 0 ? 0.0f : 1.0f;
            picture.at(x, y) += 0.2f * std::sin(0.3f * static_cast<float>(y));
        }
    }
    ImageF1 values = picture;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            values.at(x, y) *= weight.at(x, y);
    const ImageF1 sums = joint_bilateral(values, weight, picture, {1.499f, 0.2f});
    const ImageF1 grid = joint_bilateral(values, weight, picture, {1.501f, 0.2f});
    float most = 0;
    for (int y = 4; y < picture.height() - 4; ++y)
        for (int x = 4; x < picture.width() - 4; ++x)
            most = std::max(most, std::abs(sums.at(x, y) - grid.at(x, y)));
    EXPECT_LT(most, 0.03f);
}

}  // namespace
}  // namespace weft

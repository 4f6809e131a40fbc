// Which drawn forms can be used, and that all that are drawn by hand on a picture can.
#include "engine/form/drawn_form.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

using ::testing::HasSubstr;

constexpr Size kPicture{960, 540};

Matte inside(const Recti& box) {
    Matte out(kPicture);
    for (int y = box.y0; y < box.y1; ++y)
        std::fill_n(out.row(y) + box.x0, box.width(), std::uint8_t{255});
    return out;
}

// The lower half: a floor, a bed.
const Recti kBelow{0, 370, 960, 540};

FormGuide plane(std::vector<double> corners) {
    return {FormGuideKind::kPlane, std::move(corners)};
}

std::string why_not(const std::vector<FormGuide>& guides, const Recti& region) {
    const Status usable = check_drawn_form(guides, {kPicture, {}}, inside(region));
    return usable ? std::string() : usable.error().message;
}

TEST(DrawnForm, ACornerMayLieOutsideOfThePicture) {
    for (const double x : {-400.0, -63.8, 10.0}) {
        for (const double y : {520.0, 533.7, 700.0}) {
            const FormGuide guide = plane({226.99, 371.3, 632.3, 410.3, 690.2, 531.2, x, y});
            EXPECT_EQ(why_not({guide}, kBelow), "") << x << " " << y;
        }
    }
}

// Nobody draws a rectangle to the pixel: what the corners make must not depend on chance.
TEST(DrawnForm, APlaneChangesLittleWithItsCorners) {
    double least_fov = 180, most_fov = 0, least_tilt = 90, most_tilt = 0;
    for (const double x : {-80.0, -63.8, -30.0, 10.0}) {
        for (const double y : {515.0, 520.0, 533.7}) {
            const auto drawn = drawn_surface(
                plane({226.99, 371.3, 632.3, 410.3, 690.2, 531.2, x, y}), {kPicture, {}});
            ASSERT_TRUE(drawn);
            least_fov = std::min(least_fov, drawn->fov_deg);
            most_fov = std::max(most_fov, drawn->fov_deg);
            least_tilt = std::min(least_tilt, drawn->tilt_deg);
            most_tilt = std::max(most_tilt, drawn->tilt_deg);
        }
    }
    EXPECT_GT(least_fov, 18);
    EXPECT_LT(most_fov, 108);
    EXPECT_LT(most_tilt - least_tilt, 12);
}

TEST(DrawnForm, WhatCannotBeUsedSaysWhatToDo) {
    const Recti left{0, 0, 200, 540};
    EXPECT_THAT(why_not({{FormGuideKind::kBall, {700, 200, 60}}}, left),
                HasSubstr("does not lie on the region"));
    EXPECT_EQ(why_not({{FormGuideKind::kBall, {150, 200, 60}}}, left), "");
    EXPECT_THAT(why_not({{FormGuideKind::kBall, {150, 200, 60}}}, {}),
                HasSubstr("matte is empty on its reference frame"));
    EXPECT_THAT(why_not({{FormGuideKind::kParallel, {700, 10, 800, 20, 700, 300, 800, 310}}}, left),
                HasSubstr("A parallel stroke lies outside of the region"));
    EXPECT_THAT(why_not({{FormGuideKind::kParallel, {10, 10, 100, 20}}}, left),
                HasSubstr("One parallel stroke does not show a plane"));
    EXPECT_THAT(why_not({{FormGuideKind::kCylinder, {150, 110, 165, 125, 80, 10}}}, kBelow),
                HasSubstr("point at the camera"));
    EXPECT_THAT(why_not({plane({20, 20, 180, 30, 170, 200, 30, 190}),
                         {FormGuideKind::kLevel, {500, 100, 600, 100}}},
                        left),
                HasSubstr("A level stroke lies outside of the region"));
}

}  // namespace
}  // namespace weft

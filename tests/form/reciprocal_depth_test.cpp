#include "engine/form/reciprocal_depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace weft {
namespace {

constexpr Size kDepthSize{192, 108};

// Of a camera with a focal length of 1 picture width; u and v from −0.5 on.
ImageF1 depth_picture(const std::function<float(float, float)>& depth) {
    ImageF1 out(kDepthSize);
    for (int y = 0; y < kDepthSize.height; ++y) {
        for (int x = 0; x < kDepthSize.width; ++x) {
            out.at(x, y) = depth((static_cast<float>(x) + 0.5f) / 192 - 0.5f,
                                 (static_cast<float>(y) + 0.5f) / 192 - 0.28f);
        }
    }
    return out;
}

// A floor below a wall that is turned by a quarter of its distance; above it the background.
float room_depth(float u, float v) {
    if (v < -0.2f) return std::numeric_limits<float>::infinity();
    const float floor = v > 0 ? 1.5f / v : 1e6f, wall = 8 / (1 + 0.5f * u);
    return std::min(floor, wall);
}

ImageF1 reciprocal(ImageF1 depth) {
    for (int y = 0; y < depth.height(); ++y)
        for (int x = 0; x < depth.width(); ++x)
            depth.at(x, y) = 1 / depth.at(x, y);
    return depth;
}

TEST(ReciprocalDepth, PlanesTellDistancesFromTheirReciprocals) {
    const ImageF1 distances = depth_picture(room_depth);
    EXPECT_FALSE(looks_reciprocal(distances));
    EXPECT_TRUE(looks_reciprocal(reciprocal(distances)));
}

TEST(ReciprocalDepth, OneSlantedWallIsEnough) {
    const ImageF1 wall =
        depth_picture([](float u, float v) { return 5 / (1 + 0.4f * u - 0.2f * v); });
    EXPECT_FALSE(looks_reciprocal(wall));
    EXPECT_TRUE(looks_reciprocal(reciprocal(wall)));
}

// Straight in either reading, or in none.
TEST(ReciprocalDepth, WhatFacesTheCameraAndWhatIsRoundSaysNothing) {
    const ImageF1 card = depth_picture([](float, float) { return 4.0f; });
    const ImageF1 ball = depth_picture([](float u, float v) {
        const float b = 1 / (1 + u * u + v * v), inside = b * b - 0.9f * b;
        return inside > 0 ? 5 * (b - std::sqrt(inside)) : 20.0f;
    });
    for (const ImageF1& depth : {card, ball}) {
        EXPECT_FALSE(looks_reciprocal(depth));
        EXPECT_FALSE(looks_reciprocal(reciprocal(depth)));
    }
    EXPECT_FALSE(looks_reciprocal(ImageF1(kDepthSize)));
}

}  // namespace
}  // namespace weft

#include "engine/core/alpha.h"

#include <gtest/gtest.h>

#include <limits>

namespace weft {
namespace {

ImageF3 picture_of(std::initializer_list<float> reds) {
    ImageF3 out(static_cast<int>(reds.size()), 1);
    int x = 0;
    for (const float red : reds) {
        out.at(x, 0, 0) = red;
        out.at(x, 0, 1) = red / 2;
        out.at(x++, 0, 2) = red / 4;
    }
    return out;
}

ImageF1 alpha_of(std::initializer_list<float> values) {
    ImageF1 out(static_cast<int>(values.size()), 1);
    std::copy(values.begin(), values.end(), out.data());
    return out;
}

TEST(Alpha, AssociatedColoursAreMultiplied) {
    ImageF3 picture = picture_of({0.8f, 0.8f, 0.8f, 0.8f});
    associate(picture, alpha_of({1, 0.5f, 0.25f, 0}));
    EXPECT_EQ(picture, picture_of({0.8f, 0.4f, 0.2f, 0}));
}

TEST(Alpha, AGlowWithoutABodyKeepsItsLight) {
    ImageF3 picture = picture_of({0.8f, 0.4f, 0.3f});
    unassociate(picture, alpha_of({1, 0.5f, 0}));
    EXPECT_EQ(picture, picture_of({0.8f, 0.8f, 0.3f}));
}

TEST(Alpha, WithoutCoverageThePictureIsOpaque) {
    const ImageF1 never_made = alpha_of({0, 0});
    EXPECT_FALSE(has_coverage(never_made));
    EXPECT_FALSE(has_coverage({}));
    ImageF3 picture = picture_of({0.8f, 0.4f});
    associate(picture, never_made);
    unassociate(picture, never_made);
    EXPECT_EQ(picture, picture_of({0.8f, 0.4f}));
}

TEST(Alpha, WhatIsNotANumberChangesNothing) {
    ImageF3 picture = picture_of({0.8f, 0.4f});
    const ImageF1 alpha = alpha_of({std::numeric_limits<float>::quiet_NaN(), 0.5f});
    unassociate(picture, alpha);
    associate(picture, alpha);
    EXPECT_EQ(picture, picture_of({0.8f, 0.4f}));
}

}  // namespace
}  // namespace weft

#include <gtest/gtest.h>

#include <cmath>

#include "engine/composite/focus.h"
#include "engine/core/blur_inside.h"

namespace weft {
namespace {

// Squares of two greys whose edges are ideal steps under a Gaussian.
ImageF3 blurred_squares(float sigma_px) {
    ImageF3 out(240, 160);
    const auto edge = [&](float v) {  // +1 and −1 in turn, 20 px each
        const float phase = v / 20.0f;
        const float nearest = std::round(phase);
        const float away = (phase - nearest) * 20.0f;
        const float sign = static_cast<int>(nearest) % 2 == 0 ? 1.0f : -1.0f;
        return sign * std::erf(away / (sigma_px * std::sqrt(2.0f)));
    };
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const float v = 0.5f + 0.25f * edge(static_cast<float>(x) + 0.5f) *
                                       edge(static_cast<float>(y) + 0.5f);
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = v * v;
        }
    }
    return out;
}

TEST(Focus, TheBlurOfEdgesIsFound) {
    for (const float sigma : {0.8f, 1.2f, 2.0f, 3.0f}) {
        const ImageF3 picture = blurred_squares(sigma);
        EXPECT_NEAR(edge_blur_px(picture, Matte(picture.size(), 255)), sigma, 0.2f * sigma)
            << sigma;
    }
}

TEST(Focus, ThinBarsAreAsSoftAsWideOnes) {
    // 4 px each: what detail of a surface consists of.
    ImageF3 picture(240, 160);
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            const float v = x / 4 % 2 == 0 ? 0.3f : 0.7f;
            for (int c = 0; c < 3; ++c)
                picture.at(x, y, c) = v * v;
        }
    }
    const Matte all(picture.size(), 255);
    EXPECT_LT(edge_blur_px(picture, all), 0.5f);
    blur_inside(picture, all, 1.2f);
    EXPECT_NEAR(edge_blur_px(picture, all), 1.2f, 0.4f);
}

TEST(Focus, ASharpTextureGetsThePlatesEdgeWidth) {
    ImageF3 texture = blurred_squares(0.6f);
    const Matte all(texture.size(), 255);
    const float plate_px = edge_blur_px(blurred_squares(2.0f), all);
    blur_inside(texture, all, blur_between(edge_blur_px(texture, all), plate_px));
    EXPECT_NEAR(edge_blur_px(texture, all), plate_px, 0.2f * plate_px);
}

TEST(Focus, AStrongContrastIsBlurredAsFarAsTheFaintOnesOfThePlate) {
    // Black and white under a blur of light: not as wide as greys under the same.
    ImageF3 texture = blurred_squares(0.3f);
    for (int y = 0; y < texture.height(); ++y) {
        for (int i = 0; i < 3 * texture.width(); ++i)
            texture.row(y)[i] = texture.row(y)[i] > 0.25f ? 0.9f : 0.001f;
    }
    const Matte all(texture.size(), 255);
    const float plate_px = edge_blur_px(blurred_squares(1.5f), all);
    const float blur_px = blur_to_match(texture, all, edge_blur_px(texture, all), plate_px);
    blur_inside(texture, all, blur_px);
    EXPECT_NEAR(edge_blur_px(texture, all), plate_px, 0.1f * plate_px);
}

TEST(Focus, ASoftTextureInASharpPlateStaysAsItIs) {
    EXPECT_EQ(blur_between(2.0f, 0.7f), 0.0f);
    EXPECT_EQ(blur_between(0.7f, 0.0f), 0.0f);  // the plate says nothing
}

TEST(Focus, WhatLiesOutsideOfTheMatteDoesNotEnter) {
    ImageF3 picture(40, 20, 0.5f);
    Matte matte(picture.size());
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 40; ++x) {
            if (x < 20)
                matte.at(x, y) = 255;
            else
                picture.at(x, y, 0) = std::nanf("");
        }
    }
    const ImageF3 before = picture;
    blur_inside(picture, matte, 3.0f);
    for (int x = 0; x < 20; ++x)
        EXPECT_NEAR(picture.at(x, 10, 0), 0.5f, 1e-5f);
    EXPECT_EQ(picture.at(25, 10, 1), before.at(25, 10, 1));
}

TEST(Focus, OfAPictureItsEdgesAndTheStrongOnesAreFoundAtOnce) {
    const ImageF3 picture = blurred_squares(1.3f);
    const Matte all(picture.size(), 255);
    for (const float least : {0.005f, 0.03f, 0.2f}) {
        const PictureEdges found = picture_edges(picture, all, least);
        EXPECT_EQ(strong_blur_px(found), edge_blur_px(picture, all));
        const float lowest = std::min(least, found.strong);
        const std::vector<EdgeBlur> edges = edge_blurs(picture, all, lowest);
        ASSERT_EQ(found.edges.size(), edges.size());
        for (std::size_t k = 0; k < edges.size(); ++k)
            EXPECT_EQ(found.edges[k].blur_px, edges[k].blur_px);
    }
}

}  // namespace
}  // namespace weft

#include "engine/mask/band_cut.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

Matte nearer_than(ViewF1 phi, float band_px) {
    Matte undecided(phi.size());
    for (int y = 0; y < phi.height(); ++y) {
        for (int x = 0; x < phi.width(); ++x)
            undecided.at(x, y) = std::abs(phi.row(y)[x]) < band_px ? 1 : 0;
    }
    return undecided;
}

// A vertical edge of the picture at x = 20, expected by the shape at x = 16.
TEST(BandCut, TheBoundarySnapsToTheEdgeOfThePicture) {
    ImageU8x3 frame(40, 24);
    ImageF1 phi(40, 24), odds(40, 24);
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 40; ++x) {
            for (int c = 0; c < 3; ++c)
                frame.at(x, y, c) = x < 20 ? 200 : 60;
            phi.at(x, y) = 15.5f - static_cast<float>(x);
        }
    }
    const auto labels = cut_band(frame, odds, phi, nearer_than(phi, 8), 2);
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 40; ++x)
            EXPECT_EQ(labels.at(x, y), x < 20 ? 1 : 0) << x << "," << y;
    }
}

TEST(BandCut, NothingOutsideTheBandChanges) {
    const ImageU8x3 frame(40, 24, 100);
    ImageF1 phi(40, 24);
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 40; ++x)
            phi.at(x, y) = 15.5f - static_cast<float>(x);
    }
    const auto labels =
        cut_band(frame, ImageF1(40, 24, 9.0f), phi, nearer_than(phi, 4), 2);  // all for inside
    for (int x = 0; x < 40; ++x)
        EXPECT_EQ(labels.at(x, 12), x < 20 ? 1 : 0) << x;
}

TEST(BandCut, IslandsGoAndAnchoredPartsStay) {
    ImageF1 phi(30, 10, -9.0f);
    Image<std::uint8_t, 1> labels(30, 10);
    for (int y = 3; y < 7; ++y) {
        for (int x = 2; x < 8; ++x)
            labels.at(x, y) = 1;  // holds a sure pixel
        for (int x = 20; x < 23; ++x)
            labels.at(x, y) = 1;  // does not
    }
    phi.at(4, 5) = 9;
    remove_islands(labels, phi, 6, 100);
    EXPECT_EQ(labels.at(3, 4), 1);
    EXPECT_EQ(labels.at(21, 5), 0);
}

TEST(SignedDistance, IsHalfAPixelBesideTheBoundaryAndClampedFarAway) {
    Image<std::uint8_t, 1> inside(32, 8);
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 16; ++x)
            inside.at(x, y) = 1;
    }
    const ImageF1 phi = signed_distance(inside, 6);
    EXPECT_FLOAT_EQ(phi.at(15, 4), 0.5f);
    EXPECT_FLOAT_EQ(phi.at(16, 4), -0.5f);
    EXPECT_NEAR(phi.at(12, 4), 3.5f, 0.05f);
    EXPECT_FLOAT_EQ(phi.at(0, 4), 6);
    EXPECT_FLOAT_EQ(phi.at(31, 4), -6);
}

}  // namespace
}  // namespace weft

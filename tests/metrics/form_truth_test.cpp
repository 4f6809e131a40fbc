// Coordinates by formula on surfaces by formula.
#include "engine/metrics/form_truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>

namespace weft {
namespace {

constexpr Size kPicture{160, 120};
constexpr Size kPlane{512, 256};
constexpr double kFocalPx = 200;

struct Point {
    double x = 0, y = 0, z = 0;
};
struct Texel {
    double s = 0, t = 0;  // texels, x right and y down
};

// A plane through (0, 0, 5) that is turned about the horizontal axis, seen in perspective; its own
// coordinates in metres are u and v.
struct Tilted {
    double tilt = 0;
    [[nodiscard]] std::pair<double, double> own(int x, int y) const {
        const double a = (x + 0.5 - kPicture.width / 2.0) / kFocalPx;
        const double b = (y + 0.5 - kPicture.height / 2.0) / kFocalPx;
        // (u, v cos, 5 + v sin) lies on the ray (a, b, 1).
        const double v = 5 * b / (std::cos(tilt) - b * std::sin(tilt));
        return {a * (5 + v * std::sin(tilt)), v};
    }
    [[nodiscard]] Point place(int x, int y) const {
        const auto [u, v] = own(x, y);
        return {u, v * std::cos(tilt), 5 + v * std::sin(tilt)};
    }
};

// Seen from far away: a pixel is a centimetre, less where the plane is turned.
Point far_place(double tilt, int x, int y) {
    return {0.01 * x, 0.01 * y, 0.01 * y * std::tan(tilt)};
}

ImageF3 positions(const std::function<Point(int, int)>& place) {
    ImageF3 out(kPicture);
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const Point p = place(x, y);
            out.at(x, y, 0) = static_cast<float>(p.x);
            out.at(x, y, 1) = static_cast<float>(p.y);
            out.at(x, y, 2) = static_cast<float>(p.z);
        }
    }
    return out;
}

// As the layer st has them: up to whole planes, origin at the bottom left.
ImageF2 coordinates(const std::function<Texel(int, int)>& texel) {
    ImageF2 out(kPicture);
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const Texel at = texel(x, y);
            const double s = at.s / kPlane.width, t = 1 - at.t / kPlane.height;
            out.at(x, y, 0) = static_cast<float>(s - std::floor(s));
            out.at(x, y, 1) = static_cast<float>(t - std::floor(t));
        }
    }
    return out;
}

Matte whole() {
    return Matte(kPicture.width, kPicture.height, 255);
}

FormMeasures measured(const ImageF3& places, const ImageF2& st) {
    FormTruth truth(kPlane);
    truth.add(1, places, st, whole());
    return truth.summary(1);
}

TEST(FormTruth, CoordinatesThatLieOnAPlaneInPerspectiveAreNotStretched) {
    const Tilted floor{1.1};
    const FormMeasures form = measured(positions([&](int x, int y) { return floor.place(x, y); }),
                                       coordinates([&](int x, int y) {
                                           const auto [u, v] = floor.own(x, y);
                                           return Texel{90 * u, 90 * v};
                                       }));
    ASSERT_TRUE(form.stretch && form.area_percent);
    EXPECT_NEAR(form.stretch->median, 1, 0.002);
    EXPECT_NEAR(form.stretch->p90, 1, 0.005);
    EXPECT_LT(form.area_percent->p90, 0.5);
    EXPECT_EQ(form.flipped_share, 0.0);
    EXPECT_EQ(form.torn_share, 0.0);
    EXPECT_EQ(form.base_frame, 1);
}

TEST(FormTruth, FlatCoordinatesOnATiltedPlaneAreStretchedByItsCosine) {
    for (const double tilt : {0.0, 0.5, 1.0}) {
        const FormMeasures form =
            measured(positions([&](int x, int y) { return far_place(tilt, x, y); }),
                     coordinates([](int x, int y) {
                         return Texel{3.0 * x, 3.0 * y};
                     }));
        ASSERT_TRUE(form.stretch && form.area_percent);
        EXPECT_NEAR(form.stretch->median, 1 / std::cos(tilt), 0.002) << tilt;
        EXPECT_NEAR(form.stretch->p90, 1 / std::cos(tilt), 0.002) << tilt;
        EXPECT_LT(form.area_percent->p90, 0.1);
    }
}

TEST(FormTruth, FlatCoordinatesInPerspectiveAreStretchedAsTheMapSays) {
    // In the picture's middle columns: by 1 / cos on the axis; a pixel's area goes as z³.
    const Tilted floor{0.8};
    Matte strip(kPicture.width, kPicture.height, 0);
    for (int y = 0; y < strip.height(); ++y)
        std::fill_n(strip.row(y) + 70, 20, std::uint8_t{255});
    FormTruth truth(kPlane);
    truth.add(1, positions([&](int x, int y) { return floor.place(x, y); }),
              coordinates([](int x, int y) {
                  return Texel{3.0 * x, 3.0 * y};
              }),
              strip);
    const FormMeasures form = truth.summary(1);
    ASSERT_TRUE(form.stretch && form.area_percent);
    EXPECT_NEAR(form.stretch->median, 1 / std::cos(0.8), 0.02);
    // |3 ln z| for rows spread evenly, less its median.
    EXPECT_NEAR(form.area_percent->median,
                100 * 3 * std::tan(0.8) * 0.25 * kPicture.height / kFocalPx, 2);
}

TEST(FormTruth, AMirroredTextureIsFlippedEverywhere) {
    const FormMeasures form = measured(positions([](int x, int y) { return far_place(0.3, x, y); }),
                                       coordinates([](int x, int y) {
                                           return Texel{-3.0 * x, 3.0 * y};
                                       }));
    EXPECT_EQ(form.flipped_share, 1.0);
    ASSERT_TRUE(form.stretch);
    EXPECT_NEAR(form.stretch->median, 1 / std::cos(0.3), 0.002);
}

TEST(FormTruth, OnePartOfTheSurfaceFlippedIsThatShare) {
    const FormMeasures form = measured(positions([](int x, int y) { return far_place(0, x, y); }),
                                       coordinates([](int x, int y) {
                                           return Texel{3.0 * std::abs(x - 39.5), 3.0 * y};
                                       }));
    ASSERT_TRUE(form.flipped_share);
    EXPECT_NEAR(*form.flipped_share, 0.25, 0.02);
}

TEST(FormTruth, BreathingCountsAsAreaAgainstTheBaseFrame) {
    const ImageF3 places = positions([](int x, int y) { return far_place(0, x, y); });
    FormTruth truth(kPlane);
    for (const int frame : {1, 2}) {
        const double scale = frame == 1 ? 3.0 : 3.3;
        truth.add(frame, places, coordinates([&](int x, int y) {
                      return Texel{scale * x, scale * y};
                  }),
                  whole());
    }
    const FormMeasures form = truth.summary(1);
    ASSERT_TRUE(form.area_percent && form.stretch);
    EXPECT_NEAR(form.area_percent->p90, 100 * std::log(1.21), 0.1);
    EXPECT_NEAR(form.stretch->p90, 1, 0.002);
    ASSERT_EQ(form.frames.size(), 2u);
    ASSERT_TRUE(form.frames[0].area_shift_percent && form.frames[1].area_shift_percent);
    EXPECT_NEAR(*form.frames[0].area_shift_percent, 0, 0.01);
    EXPECT_NEAR(*form.frames[1].area_shift_percent, 100 * std::log(1.21), 0.1);
    // A frame that was not measured: the first that shows the surface is the base.
    EXPECT_EQ(truth.summary(7).base_frame, 1);
    EXPECT_EQ(truth.summary(2).base_frame, 2);
}

TEST(FormTruth, AJumpOfTheCoordinatesIsTorn) {
    const FormMeasures form = measured(positions([](int x, int y) { return far_place(0, x, y); }),
                                       coordinates([](int x, int y) {
                                           return Texel{3.0 * x + (x < 80 ? 0 : 20), 3.0 * y};
                                       }));
    ASSERT_TRUE(form.torn_share && form.stretch);
    // Two columns of the 158 that are measured.
    EXPECT_NEAR(*form.torn_share, 2.0 / 158, 1e-6);
    EXPECT_NEAR(form.stretch->median, 1, 0.002);
}

TEST(FormTruth, TheOutlineIsLeftOutAndItsRingToldByItself) {
    // Inside a box the texture lies flat; within 10 px of its edge it is stretched to 2.
    Matte matte(kPicture.width, kPicture.height, 0);
    for (int y = 20; y < 100; ++y)
        for (int x = 20; x < 140; ++x)
            matte.at(x, y) = 255;
    const auto texel = [](int x, int y) {
        const double inner = x - 30;
        return Texel{x < 30 ? 6 * inner : 3 * inner, 3.0 * y};
    };
    FormTruth truth(kPlane);
    const auto seen = truth.add(1, positions([](int x, int y) { return far_place(0, x, y); }),
                                coordinates(texel), matte);
    EXPECT_EQ(seen.inside, 112 * 72);
    EXPECT_EQ(seen.laid, seen.inside);
    const FormMeasures form = truth.summary(1);
    ASSERT_TRUE(form.stretch && form.rim_stretch);
    EXPECT_EQ(form.pixels, seen.inside);
    EXPECT_NEAR(form.stretch->p90, 1, 0.002);
    EXPECT_NEAR(form.rim_stretch->p90, 2, 0.002);
}

TEST(FormTruth, GrazingViewsFoldsAndUnknownPlacesDoNotCount) {
    const ImageF2 flat = coordinates([](int x, int y) { return Texel{3.0 * x, 3.0 * y}; });
    const FormMeasures grazing =
        measured(positions([](int x, int y) { return far_place(1.45, x, y); }), flat);
    EXPECT_EQ(grazing.pixels, 0);
    EXPECT_FALSE(grazing.base_frame || grazing.stretch || grazing.flipped_share);
    // A roof: the ridge and the columns beside it.
    const FormMeasures roof =
        measured(positions([](int x, int y) {
                     return Point{0.01 * x, 0.01 * y, 0.01 * std::abs(x - 80)};
                 }),
                 flat);
    EXPECT_LT(roof.pixels, 158 * 118);
    EXPECT_GE(roof.pixels, 153 * 118);
    EXPECT_NEAR(roof.stretch.value_or(MedianAnd90()).p90, std::numbers::sqrt2, 0.002);
    const float unknown = std::numeric_limits<float>::quiet_NaN();
    ImageF3 half = positions([](int x, int y) { return far_place(0, x, y); });
    for (int y = 0; y < half.height(); ++y)
        for (int x = 0; x < 80; ++x)
            half.at(x, y, 2) = unknown;
    const FormMeasures known = measured(half, flat);
    EXPECT_LE(known.pixels, 79 * 118);
    EXPECT_GE(known.pixels, 76 * 118);
}

TEST(FormTruth, TheCosineIsThatOfThePixelsOwnRay) {
    // At the right and the left border the rays are 22° off the axis, and a wall seen at a cosine
    // of 0.3 in the middle is seen along itself on one side.
    const double turn = std::acos(0.3);
    const auto place = [&](int x, int y) {
        const double a = (x + 0.5 - kPicture.width / 2.0) / kFocalPx;
        const double b = (y + 0.5 - kPicture.height / 2.0) / kFocalPx;
        const double z = 5 / (1 - a * std::tan(turn));
        return Point{a * z, b * z, z};
    };
    int wanted = 0;
    for (int x = 1; x < kPicture.width - 1; ++x) {
        for (int y = 1; y < kPicture.height - 1; ++y) {
            const double a = (x + 0.5 - kPicture.width / 2.0) / kFocalPx;
            const double b = (y + 0.5 - kPicture.height / 2.0) / kFocalPx;
            const double cosine =
                (std::cos(turn) - a * std::sin(turn)) / std::sqrt(1 + a * a + b * b);
            wanted += cosine >= 0.15 ? 1 : 0;
        }
    }
    FormTruth truth(kPlane, kFocalPx);
    truth.add(1, positions(place), coordinates([](int x, int y) {
                  return Texel{3.0 * x, 3.0 * y};
              }),
              whole());
    EXPECT_NEAR(static_cast<double>(truth.summary(1).pixels), wanted, 0.005 * wanted);
}

TEST(FormTruth, FoldsAreThoseOfTheNormalPassIfThereIsOne) {
    const ImageF3 places = positions([](int x, int y) { return far_place(0, x, y); });
    const ImageF2 flat = coordinates([](int x, int y) { return Texel{3.0 * x, 3.0 * y}; });
    ImageF3 normals(kPicture);
    for (int y = 0; y < normals.height(); ++y) {
        for (int x = 0; x < normals.width(); ++x)
            normals.at(x, y, x < 80 ? 0 : 2) = 1;
    }
    FormTruth truth(kPlane);
    truth.add(1, places, flat, whole(), normals);
    EXPECT_EQ(truth.summary(1).pixels, 156 * 118);
}

TEST(FormTruth, SaysWhatIsMissing) {
    const ImageF3 nowhere(kPicture.width, kPicture.height, std::numeric_limits<float>::quiet_NaN());
    const ImageF2 flat = coordinates([](int x, int y) { return Texel{3.0 * x, 3.0 * y}; });
    FormTruth truth(kPlane);
    const auto unplaced = truth.add(1, nowhere, flat, whole());
    EXPECT_EQ(unplaced.inside, 158 * 118);
    EXPECT_EQ(unplaced.placed, 0);
    const auto bare = truth.add(2, positions([](int x, int y) { return far_place(0, x, y); }),
                                ImageF2(kPicture), whole());
    EXPECT_EQ(bare.placed, 158 * 118);
    EXPECT_EQ(bare.laid, 0);
}

TEST(ValueCounts, QuantilesAreThoseOfTheValues) {
    ValueCounts counts;
    for (int i = 0; i <= 1000; ++i)
        counts.add(-3 + 0.006 * i);
    EXPECT_EQ(counts.count(), 1001);
    EXPECT_NEAR(counts.quantile(0.5), 0, 0.004);
    EXPECT_NEAR(counts.quantile(0.9), 2.4, 0.008);
    EXPECT_NEAR(counts.distance_quantile(1, 0.5), 1.5, 0.008);
    counts.add(1e300);
    counts.add(-1e300);
    EXPECT_NEAR(counts.quantile(1), 40, 0.001);
}

}  // namespace
}  // namespace weft

// The estimate against a rendered clip whose unlit colour is known.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "engine/color/color_space.h"
#include "engine/lighting/shading.h"
#include "tests/lighting/lighting_scene.h"
#include "tests/support/places.h"

namespace weft {
namespace {

const std::string kClip = test::shared_data_folder() + "/sequences/blender_fox_gt/";

ImageF3 read_linear(const std::string& path) {
    const cv::Mat m = cv::imread(path, cv::IMREAD_COLOR);
    ImageF3 out(m.cols, m.rows);
    for (int y = 0; y < m.rows; ++y) {
        for (int x = 0; x < m.cols; ++x) {
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) =
                    srgb_to_linear(static_cast<float>(m.at<cv::Vec3b>(y, x)[2 - c]) / 255.0f);
        }
    }
    return out;
}

Matte read_id(int id) {
    const cv::Mat m = cv::imread(kClip + "masks_ids/00000.png", cv::IMREAD_GRAYSCALE);
    Matte out(m.cols, m.rows);
    for (int y = 0; y < m.rows; ++y) {
        for (int x = 0; x < m.cols; ++x)
            out.at(x, y) = m.at<unsigned char>(y, x) == id ? 255 : 0;
    }
    return out;
}

float pixel_luminance(const float* p) {
    return 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
}

// Of the estimate and luminance / albedo, over pixels whose neighbours belong to the object too.
double truth_correlation(const Shading& s, const ImageF3& lit, const ImageF3& albedo,
                         const Matte& matte) {
    double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
    for (int y = 1; y + 1 < matte.height(); ++y) {
        for (int x = 1; x + 1 < matte.width(); ++x) {
            bool whole = true;
            for (int v = -1; v <= 1; ++v) {
                for (int u = -1; u <= 1; ++u)
                    whole = whole && matte.at(x + u, y + v);
            }
            const double paint = pixel_luminance(albedo.pixel(x, y));
            if (!whole || paint < 0.015) continue;
            const double truth = pixel_luminance(lit.pixel(x, y)) / paint;
            const double estimate = s.value.at(x / s.downscale, y / s.downscale);
            n += 1, a += estimate, b += truth;
            aa += estimate * estimate, bb += truth * truth, ab += estimate * truth;
        }
    }
    return (ab / n - a * b / n / n) /
           std::sqrt((aa / n - a * a / n / n) * (bb / n - b * b / n / n));
}

class TrueShading : public testing::Test {
  protected:
    void SetUp() override {
        if (!std::filesystem::exists(kClip)) GTEST_SKIP() << "the evaluation clips are not here";
        lit_ = read_linear(kClip + "frames/00000.png");
        albedo_ = read_linear(kClip + "albedo/00000.png");
    }
    double correlation_of(int id) {
        const Matte matte = read_id(id);
        return truth_correlation(estimate_shading(lit_, matte, {}), lit_, albedo_, matte);
    }
    ImageF3 lit_, albedo_;
};

TEST_F(TrueShading, IsFoundOnGroundBallAndCloth) {
    EXPECT_GT(correlation_of(1), 0.87);
    EXPECT_GT(correlation_of(3), 0.95);
    EXPECT_GT(correlation_of(4), 0.85);
}

TEST_F(TrueShading, IsFoundInPartOnASmallFacetedCharacter) {
    EXPECT_GT(correlation_of(5), 0.55);
}

TEST_F(TrueShading, AGreyWallShowsATenthOfTheBricksThatABlurLeaves) {
    const Matte wall = read_id(2);
    const Shading s = estimate_shading(lit_, wall, {});
    const ImageF1 blurred = scene::gaussian_estimate(lit_, wall, 7.0f);
    ImageF1 half(s.value.size());
    Matte region(s.value.size());
    for (int y = 0; y < half.height(); ++y) {
        for (int x = 0; x < half.width(); ++x) {
            half.at(x, y) = blurred.at(2 * x, 2 * y);
            region.at(x, y) = s.inside.at(x, y);
        }
    }
    EXPECT_LT(scene::detail_energy(s.value, region, 7),
              0.1 * scene::detail_energy(half, region, 7));
}

}  // namespace
}  // namespace weft

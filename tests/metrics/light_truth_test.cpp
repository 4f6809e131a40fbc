// Estimated light beside a true one, and a result beside a true picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/color/color_space.h"
#include "engine/core/rng.h"
#include "engine/metrics/light_truth.h"
#include "engine/metrics/truth.h"

namespace weft {
namespace {

constexpr Size kLitSize{160, 120};

// Light 1 on the left, `dark` on the right of `edge_px`, over a ramp `width_px` wide.
ImageF1 half_dark(float edge_px, float width_px, float dark) {
    ImageF1 out(kLitSize);
    for (int y = 0; y < kLitSize.height; ++y) {
        for (int x = 0; x < kLitSize.width; ++x) {
            const float t =
                std::clamp((static_cast<float>(x) + 0.5f - edge_px) / width_px + 0.5f, 0.0f, 1.0f);
            out.at(x, y) = 1.0f + t * (dark - 1.0f);
        }
    }
    return out;
}

Matte everywhere() {
    return Matte(kLitSize, 255);
}

TEST(CompareShading, KnowsTheSameLightAtAnyExposure) {
    const ImageF1 truth = half_dark(80, 4, 0.3f);
    ImageF1 twice = truth;
    for (int y = 0; y < kLitSize.height; ++y) {
        for (int x = 0; x < kLitSize.width; ++x)
            twice.at(x, y) *= 2;
    }
    const ShadingAgreement same = compare_shading(twice, truth, everywhere());
    EXPECT_NEAR(*same.correlation, 1.0, 1e-6);
    EXPECT_LT(same.error_levels, 0.01);
    EXPECT_GT(same.true_deviation_levels, 20);
    EXPECT_FALSE(compare_shading(ImageF1(kLitSize, 1.0f), truth, everywhere()).correlation);
}

TEST(CompareShading, LeavesOutWhatIsOutsideOrNotFinite) {
    const ImageF1 truth = half_dark(80, 4, 0.3f);
    ImageF1 wrong = truth;
    Matte inside = everywhere();
    for (int x = 0; x < kLitSize.width; ++x)
        wrong.at(x, 0) = 9, inside.at(x, 0) = 0, wrong.at(x, 1) = std::nanf("");
    const ShadingAgreement found = compare_shading(wrong, truth, inside);
    EXPECT_NEAR(*found.correlation, 1.0, 1e-6);
    EXPECT_EQ(found.pixels, kLitSize.width * (kLitSize.height - 2));
}

TEST(ShadowEdges, MeasuresWidthAndLag) {
    ShadowEdges edges;
    // An edge 80 px in, 6 px wide; in the result it is 9 px wide and 2 px off.
    edges.add(half_dark(82, 9, 0.4f), half_dark(80, 6, 0.4f), everywhere());
    const ShadowEdges::Summary found = edges.summary();
    EXPECT_GT(found.edges, 8);
    // Profiles are of ln light, in which both edges keep their form.
    EXPECT_NEAR(found.width_ratio, 1.5, 0.08);
    EXPECT_NEAR(found.lag_px, 2.0, 0.45);
    EXPECT_EQ(found.missing_share, 0);
}

TEST(ShadowEdges, CountsThoseThatAreMissing) {
    ShadowEdges edges;
    edges.add(ImageF1(kLitSize, 1.0f), half_dark(80, 6, 0.4f), everywhere());
    EXPECT_GT(edges.summary().edges, 8);
    EXPECT_EQ(edges.summary().missing_share, 1);
}

ImageF3 grey_under(const ImageF1& light, float reflectance) {
    ImageF3 out(light.size());
    for (int y = 0; y < light.height(); ++y) {
        for (int x = 0; x < light.width(); ++x) {
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = linear_to_srgb(reflectance * light.at(x, y));
        }
    }
    return out;
}

Matte disc_with_soft_edge() {
    Matte out(kLitSize);
    for (int y = 0; y < kLitSize.height; ++y) {
        for (int x = 0; x < kLitSize.width; ++x) {
            const float r = std::hypot(static_cast<float>(x) - 80, static_cast<float>(y) - 60);
            out.at(x, y) =
                static_cast<std::uint8_t>(255 * std::clamp((50 - r) / 4 + 0.5f, 0.0f, 1.0f));
        }
    }
    return out;
}

TEST(TruthComparison, ForgivesOneGainAndSeesWhereAResultIsWrong) {
    const Matte matte = disc_with_soft_edge();
    const ImageF3 truth = grey_under(half_dark(100, 4, 0.4f), 0.5f);
    TruthComparison same;
    const ImageF3 darker = grey_under(half_dark(100, 4, 0.4f), 0.25f);
    same.gather(darker, truth, matte);
    EXPECT_LT(*same.compare(darker, truth, matte).inside, 0.1);

    // Without the shadow: wrong in it, and on the whole.
    TruthComparison flat;
    const ImageF3 lit = grey_under(ImageF1(kLitSize, 1.0f), 0.5f);
    flat.gather(lit, truth, matte);
    const TruthComparison::Frame found = flat.compare(lit, truth, matte);
    EXPECT_GT(*found.shadow, 25);
    EXPECT_GT(*found.soft_edge, 8);
}

TEST(TruthComparison, TheGainIsTheMaterialsNotTheBackgrounds) {
    const Matte matte = disc_with_soft_edge();
    // The same disc before a bright background, half as bright as the true one.
    const auto before_background = [&](float reflectance) {
        ImageF3 out(kLitSize);
        for (int y = 0; y < kLitSize.height; ++y) {
            for (int x = 0; x < kLitSize.width; ++x) {
                const float m = matte.at(x, y) / 255.0f;
                for (int c = 0; c < 3; ++c)
                    out.at(x, y, c) = linear_to_srgb(m * reflectance + (1 - m) * 0.8f);
            }
        }
        return out;
    };
    const ImageF3 truth = before_background(0.4f), darker = before_background(0.2f);
    TruthComparison comparison;
    comparison.gather(darker, truth, matte);
    EXPECT_LT(*comparison.compare(darker, truth, matte).soft_edge, 0.1);
}

TEST(TruthComparison, FollowsADimmingLight) {
    const Matte matte = disc_with_soft_edge();
    TruthComparison comparison;
    const ImageF3 bright = grey_under(ImageF1(kLitSize, 1.0f), 0.5f);
    const ImageF3 dim = grey_under(ImageF1(kLitSize, 0.6f), 0.5f);
    const ImageF3 less = grey_under(ImageF1(kLitSize, 0.8f), 0.5f);
    comparison.gather(bright, bright, matte);
    comparison.gather(less, dim, matte);
    EXPECT_EQ(comparison.compare(bright, bright, matte).true_brightness, 1);
    const TruthComparison::Frame second = comparison.compare(less, dim, matte);
    EXPECT_NEAR(second.true_brightness, 0.6, 1e-3);
    EXPECT_NEAR(second.brightness, 0.8, 1e-3);
    EXPECT_FALSE(second.shadow);
}

TEST(TruthComparison, AfterABlurThePlaceOfATexelDoesNotMatter) {
    const Matte matte = everywhere();
    ImageF3 a(kLitSize), b(kLitSize);
    Rng rng(3);
    for (int y = 0; y < kLitSize.height; ++y) {
        for (int x = 0; x < kLitSize.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                a.at(x, y, c) = 0.4f + 0.2f * static_cast<float>(rng.uniform());
                b.at(x, y, c) = 0.4f + 0.2f * static_cast<float>(rng.uniform());
            }
        }
    }
    TruthComparison sharp, soft(8);
    sharp.gather(a, b, matte), soft.gather(a, b, matte);
    EXPECT_GT(*sharp.compare(a, b, matte).inside, 10);
    EXPECT_LT(*soft.compare(a, b, matte).inside, 1.5);
}

}  // namespace
}  // namespace weft

#include "engine/mask/matte_edge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/core/parallel.h"
#include "engine/core/rng.h"
#include "engine/mask/box_gaussian.h"
#include "engine/mask/edge_shift.h"
#include "engine/mask/level_distance.h"
#include "engine/mask/matte_cleaning.h"

namespace weft {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// Coverage of what is inside where `distance` (of a place in pixels) is above 0, by sampling.
template <class Distance>
ImageF1 covered(Size size, Distance&& distance) {
    constexpr int kSteps = 8;
    ImageF1 out(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const float middle =
                distance({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
            if (std::abs(middle) > 1) {
                out.at(x, y) = middle > 0 ? 1.0f : 0.0f;
                continue;
            }
            int inside = 0;
            for (int k = 0; k < kSteps * kSteps; ++k) {
                const auto part = [](int i) { return (static_cast<float>(i) + 0.5f) / kSteps; };
                const Vec2 p(static_cast<float>(x) + part(k % kSteps),
                             static_cast<float>(y) + part(k / kSteps));
                inside += distance(p) > 0 ? 1 : 0;
            }
            out.at(x, y) = static_cast<float>(inside) / (kSteps * kSteps);
        }
    }
    return out;
}

ImageF1 disc(float radius, Size size = {160, 160}, Vec2 centre = {80.3f, 79.6f}) {
    return covered(size,
                   [&](Vec2 p) { return radius - std::hypot(p.x - centre.x, p.y - centre.y); });
}

double area(const ImageF1& alpha) {
    return std::accumulate(alpha.data(), alpha.data() + alpha.size_bytes() / sizeof(float), 0.0);
}

float largest_difference(const ImageF1& a, const ImageF1& b) {
    float most = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            most = std::max(most, std::abs(a.at(x, y) - b.at(x, y)));
    return most;
}

// A ramp that falls to the right from 1 to 0 over `width_px` around `middle`.
ImageF1 ramp(Size size, float middle, float width_px) {
    ImageF1 out(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            out.at(x, y) =
                std::clamp(0.5f + (middle - (static_cast<float>(x) + 0.5f)) / width_px, 0.0f, 1.0f);
    return out;
}

Matte codes(const ImageF1& alpha) {
    Matte out(alpha.size());
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            out.at(x, y) = static_cast<std::uint8_t>(std::lround(alpha.at(x, y) * 255));
    return out;
}

TEST(LevelDistance, IsThatOfAStraightEdgeOfAnySlope) {
    const Size size{64, 64};
    for (const float degrees : {0.0f, 7.0f, 20.0f, 33.0f, 45.0f, 71.0f, 90.0f, 160.0f, 265.0f}) {
        const Vec2 n(std::cos(degrees * kPi / 180), std::sin(degrees * kPi / 180));
        const auto truth = [&](Vec2 p) { return n.x * (p.x - 32.2f) + n.y * (p.y - 31.7f); };
        const ImageF1 phi = level_distance(covered(size, truth), 0.5f, 12);
        for (int y = 14; y < 50; ++y) {
            for (int x = 14; x < 50; ++x) {
                const float d = truth({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
                ASSERT_NEAR(phi.at(x, y), std::clamp(d, -12.0f, 12.0f), 0.06f)
                    << degrees << " deg, " << x << ' ' << y;
            }
        }
    }
}

TEST(LevelDistance, HasNoLineAtTheBorder) {
    const ImageF1 phi = level_distance(ImageF1(20, 10, 1.0f), 0.5f, 5);
    EXPECT_EQ(phi, ImageF1(20, 10, 5.0f));
    EXPECT_EQ(level_distance(ImageF1(20, 10, 0.0f), 0.5f, 5), ImageF1(20, 10, -5.0f));
}

TEST(MatteEdge, WithoutSettingsLeavesEveryByte) {
    const Matte matte = codes(disc(40.2f));
    EXPECT_EQ(with_edge(matte, {}), matte);
    EXPECT_EQ(with_edge(Matte(), {.choke_px = 3}), Matte());
    EXPECT_EQ(with_edge(Matte(30, 20), {.choke_px = 3, .blur_px = 2}), Matte(30, 20));
}

TEST(Choke, MovesTheEdgeOfADiscByItsAmount) {
    for (const float radius : {20.0f, 40.7f}) {
        const ImageF1 alpha = disc(radius);
        for (const float choke :
             {-12.0f, -5.0f, -3.3f, -0.7f, -0.1f, 0.1f, 0.5f, 2.0f, 7.3f, 25.0f}) {
            const ImageF1 moved = with_edge(alpha.view(), {.choke_px = choke});
            const double wanted = kPi * (radius + choke) * (radius + choke);
            EXPECT_NEAR(area(moved), wanted, 0.01 * wanted) << radius << " by " << choke;
            // As sharp as one that is drawn so.
            EXPECT_LT(largest_difference(moved, disc(radius + choke)), 0.15f)
                << radius << " by " << choke;
        }
    }
}

TEST(Choke, GrowsEvenlyInTenthsOfAPixel) {
    const ImageF1 alpha = disc(40);
    double before = area(with_edge(alpha.view(), {.choke_px = -1.5f}));
    for (int k = -14; k <= 15; ++k) {
        const float choke = 0.1f * static_cast<float>(k);
        const double now = area(with_edge(alpha.view(), {.choke_px = choke}));
        EXPECT_NEAR(now - before, 0.1 * 2 * kPi * (40 + choke), 3) << choke;
        before = now;
    }
}

TEST(Choke, MovesASoftEdgeAsAWhole) {
    const Size size{120, 24};
    for (const float width : {6.0f, 30.0f}) {
        for (const float choke : {-9.4f, -0.3f, 3.3f, 14.0f}) {
            const ImageF1 moved = with_edge(ramp(size, 60.3f, width).view(), {.choke_px = choke});
            EXPECT_LT(largest_difference(moved, ramp(size, 60.3f + choke, width)), 0.04f)
                << width << " px wide by " << choke;
        }
    }
}

TEST(Choke, KeepsTheValueOfWhatIsSemiTransparent) {
    ImageF1 alpha = disc(40);
    for (int y = 0; y < alpha.height(); ++y)
        for (int x = 0; x < alpha.width(); ++x)
            alpha.at(x, y) *= 0.3f;
    const ImageF1 grown = with_edge(alpha.view(), {.choke_px = 6});
    EXPECT_NEAR(grown.at(80, 80), 0.3f, 0.005f);
    EXPECT_NEAR(area(grown), 0.3 * kPi * 46 * 46, 0.01 * 0.3 * kPi * 46 * 46);
    const ImageF1 shrunk = with_edge(alpha.view(), {.choke_px = -6});
    EXPECT_NEAR(area(shrunk), 0.3 * kPi * 34 * 34, 0.015 * 0.3 * kPi * 34 * 34);
}

TEST(Choke, LeavesTheFramesBorder) {
    const ImageF1 left = ramp({60, 40}, 20, 1);
    EXPECT_LT(largest_difference(with_edge(left.view(), {.choke_px = -6}), ramp({60, 40}, 14, 1)),
              0.01f);
    EXPECT_LT(
        largest_difference(with_edge(left.view(), {.choke_px = 9.5f}), ramp({60, 40}, 29.5f, 1)),
        0.01f);
}

TEST(Feather, LeavesTheInnerOrTheOuterEnd) {
    const Size size{80, 16};
    const ImageF1 edge = ramp(size, 40, 1);
    const ImageF1 out = with_edge(edge.view(), {.feather_px = 10});
    const ImageF1 in = with_edge(edge.view(), {.feather_px = -10});
    for (int x = 0; x < 80; ++x) {
        const float at = static_cast<float>(x) + 0.5f;
        EXPECT_NEAR(out.at(x, 8), std::clamp((50.5f - at) / 11, 0.0f, 1.0f), 0.01f) << x;
        EXPECT_NEAR(in.at(x, 8), std::clamp((40.5f - at) / 11, 0.0f, 1.0f), 0.01f) << x;
    }
    // Of a soft edge too: what was whole stays whole, what was empty stays empty.
    const ImageF1 soft = ramp(size, 40, 12);
    const ImageF1 wider = with_edge(soft.view(), {.feather_px = 8});
    const ImageF1 inner = with_edge(soft.view(), {.feather_px = -8});
    EXPECT_LT(largest_difference(wider, ramp(size, 44, 20)), 0.03f);
    EXPECT_LT(largest_difference(inner, ramp(size, 36, 20)), 0.03f);
}

TEST(Smooth, TakesTheRaggednessAndLeavesTheShape) {
    ImageF1 ragged = disc(50);
    const double drawn = area(ragged);
    Rng rng(3, 1);
    for (int y = 0; y < 160; ++y) {
        for (int x = 0; x < 160; ++x) {
            const float d = 50 - std::hypot(static_cast<float>(x) + 0.5f - 80.3f,
                                            static_cast<float>(y) + 0.5f - 79.6f);
            if (std::abs(d) < 1.5f) ragged.at(x, y) = rng.uniform() < 0.5 ? 0.0f : 1.0f;
        }
    }
    const ImageF1 smooth = with_edge(ragged.view(), {.smooth_px = 4});
    EXPECT_NEAR(area(smooth), area(ragged), 0.01 * drawn);
    const double off_before = [&] {
        double sum = 0;
        const ImageF1 truth = disc(50);
        for (int y = 0; y < 160; ++y)
            for (int x = 0; x < 160; ++x)
                sum += std::abs(ragged.at(x, y) - truth.at(x, y));
        return sum;
    }();
    double off = 0;
    const ImageF1 truth = disc(50);
    for (int y = 0; y < 160; ++y)
        for (int x = 0; x < 160; ++x)
            off += std::abs(smooth.at(x, y) - truth.at(x, y));
    EXPECT_LT(off, 0.35 * off_before);
    // A clean disc keeps its radius: a Gaussian alone would take 0.4 px.
    const double kept = std::sqrt(area(with_edge(disc(20).view(), {.smooth_px = 4})) / kPi);
    EXPECT_NEAR(kept, 20, 0.15);
    EXPECT_LT(largest_difference(with_edge(ramp({90, 40}, 45, 14).view(), {.smooth_px = 4}),
                                 ramp({90, 40}, 45, 14)),
              0.02f);
}

TEST(Cleaning, RemovesIslandsWithTheirSoftRims) {
    const Size size{120, 80};
    const auto spots = [&](bool small) {
        return covered(size, [&](Vec2 p) {
            const float big = 25 - std::hypot(p.x - 40, p.y - 40);
            const float islet = 3 - std::hypot(p.x - 90.3f, p.y - 30.2f);
            return small ? std::max(big, islet) : big;
        });
    };
    const ImageF1 cleaned = with_edge(spots(true).view(), {.min_island_px = 40});
    EXPECT_EQ(cleaned, spots(false));
    EXPECT_EQ(with_edge(spots(true).view(), {.min_island_px = 20}), spots(true));
}

TEST(Cleaning, RemovesFaintSpotsAndFillsHoles) {
    ImageF1 alpha = disc(30);
    const ImageF1 clean = alpha;
    alpha.at(5, 5) = 0.3f;
    alpha.at(80, 80) = 0;
    alpha.at(81, 80) = 0.4f;
    alpha.at(82, 80) = 0.8f;  // soft rim of the hole
    EXPECT_EQ(with_edge(alpha.view(), {.min_island_px = 4, .min_hole_px = 4}), clean);
    ImageF1 holes = alpha;
    fill_holes(holes, 2);
    EXPECT_EQ(holes.at(81, 80), 0.4f) << "two pixels are not fewer than two";
    ImageF1 islands = alpha;
    remove_islands(islands, 4);
    EXPECT_EQ(islands.at(5, 5), 0);
    EXPECT_EQ(islands.at(80, 80), 0);
}

TEST(Cleaning, LeavesWhatReachesTheBorderOpen) {
    ImageF1 alpha(20, 20, 1.0f);
    alpha.at(0, 10) = 0;
    fill_holes(alpha, 100);
    EXPECT_EQ(alpha.at(0, 10), 0);
}

TEST(BoxGaussian, HasTheVarianceOfItsSigma) {
    for (const float sigma : {0.3f, 1.0f, 2.7f, 9.0f}) {
        ImageF1 point(121, 121);
        point.at(60, 60) = 1;
        const ImageF1 blurred = box_gaussian(point, sigma);
        double sum = 0, moment = 0;
        for (int y = 0; y < 121; ++y) {
            for (int x = 0; x < 121; ++x) {
                sum += static_cast<double>(blurred.at(x, y));
                moment += static_cast<double>(blurred.at(x, y)) * (x - 60) * (x - 60);
            }
        }
        EXPECT_NEAR(sum, 1, 1e-5);
        EXPECT_NEAR(moment, static_cast<double>(sigma) * sigma, 1e-3 * sigma * sigma) << sigma;
        EXPECT_LE(3 * sigma, static_cast<float>(box_gaussian_reach(sigma)) + 0.5f);
    }
}

TEST(MatteEdge, IsTheSameForAnyNumberOfThreads) {
    ImageF1 alpha = disc(50, {300, 220}, {130, 100});
    Rng rng(5, 2);
    for (int y = 0; y < alpha.height(); ++y)
        for (int x = 200; x < 240; ++x)
            alpha.at(x, y) = static_cast<float>(rng.uniform());
    const MatteEdge all{.min_island_px = 6,
                        .min_hole_px = 6,
                        .smooth_px = 1.5f,
                        .choke_px = 2.3f,
                        .feather_px = 5,
                        .blur_px = 1.2f};
    set_thread_count(1);
    const ImageF1 one = with_edge(alpha.view(), all);
    set_thread_count(4);
    const ImageF1 many = with_edge(alpha.view(), all);
    set_thread_count(0);
    EXPECT_EQ(one, many);
}

TEST(MatteEdgePlan, TakesItsKeysAndSmallerFrames) {
    MatteEdgePlan plan;
    EXPECT_TRUE(plan.none());
    plan.edge.blur_px = 4;
    plan.edge.min_island_px = 10;
    plan.choke_keys = {{{1, {0}}, {5, {8}}}};
    EXPECT_EQ(plan.at(3).choke_px, 4);
    EXPECT_EQ(plan.at(3).blur_px, 4);
    const MatteEdgePlan small = divided(plan, 4);
    EXPECT_EQ(small.at(5).choke_px, 2);
    EXPECT_EQ(small.at(5).blur_px, 1);
    EXPECT_EQ(small.at(5).min_island_px, 1);
    EXPECT_FALSE(plan.none());
}

TEST(EdgeShift, ReachesAsFarAsItsFarthestLevel) {
    EXPECT_EQ((EdgeShift{2, 5, 0}.reach()), 7);
    EXPECT_EQ((EdgeShift{-2, 0, -5}.reach()), 7);
    EXPECT_EQ((EdgeShift{2, 5, 0}.of(1)), 2);
}

}  // namespace
}  // namespace weft

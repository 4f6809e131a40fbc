// Feathering, guides and refinement.

#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/parallel.h"
#include "engine/core/rng.h"
#include "engine/synthesis/texture_plane.h"
#include "tests/synthesis/samples.h"

namespace weft::test {
namespace {

// Mean absolute step across the plane's seams.
double step_over_seams(const TexturePlane& plane) {
    double sum = 0;
    int n = 0;
    for (int y = 0; y < plane.source.height(); ++y) {
        for (int x = 0; x + 1 < plane.source.width(); ++x) {
            const auto *p = plane.source.pixel(x, y), *q = plane.source.pixel(x + 1, y);
            if (q[0] == p[0] + 1 && q[1] == p[1]) continue;
            for (int c = 0; c < 3; ++c) {
                sum += std::abs(plane.pixels.at(x, y, c) - plane.pixels.at(x + 1, y, c));
            }
            n += 3;
        }
    }
    return sum / n;
}

TEST(Feather, SoftensSeamsAndLeavesTheRest) {
    const ImageU8x3 sample = blob_sample(96, 96, 1);
    for (const bool tileable : {false, true}) {
        PlaneOptions o = sized(220, 200);
        o.tileable = tileable;
        const TexturePlane hard = *grow_plane(sample, o);
        o.feather_px = 3;
        const TexturePlane soft = *grow_plane(sample, o);
        EXPECT_EQ(hard.source, soft.source);
        expect_sound(sample, soft, o);
        EXPECT_LT(step_over_seams(soft), 0.9 * step_over_seams(hard));
        int changed = 0, far = 0;
        for (int y = 0; y < 200; ++y) {
            for (int x = 0; x < 220; ++x) {
                const bool same = std::equal(soft.pixels.pixel(x, y), soft.pixels.pixel(x, y) + 3,
                                             hard.pixels.pixel(x, y));
                changed += !same;
                bool seam = false;
                const auto* p = hard.source.pixel(x, y);
                for (int dy = -4; dy <= 4; ++dy) {
                    for (int dx = -4; dx <= 4; ++dx) {
                        const auto* q =
                            hard.source.pixel((x + dx + 220) % 220, (y + dy + 200) % 200);
                        seam |= q[0] - dx != p[0] || q[1] - dy != p[1];
                    }
                }
                far += !seam && !same;
            }
        }
        EXPECT_GT(changed, 1000);
        EXPECT_EQ(far, 0);
    }
}

TEST(Guide, ThePlaneResemblesItWhereItIsKnown) {
    // A sample that is dark on its left and bright on its right; the guide asks for the reverse.
    ImageU8x3 sample = blob_sample(96, 96, 2);
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) {
            for (int c = 0; c < 3; ++c) {
                const int v = sample.at(x, y, c) / 3 + (x >= 48 ? 150 : 10);
                sample.at(x, y, c) = static_cast<std::uint8_t>(v);
            }
        }
    }
    PlaneOptions o = sized(240, 240);
    ImageU8x3 target(240, 240);
    Matte known(240, 240, 255);
    for (int y = 0; y < 240; ++y) {
        for (int x = 0; x < 240; ++x) {
            for (int c = 0; c < 3; ++c)
                target.at(x, y, c) = y < 120 ? 190 : 50;
        }
    }
    const auto contrast = [&](const ImageU8x3& p) {
        double top = 0, bottom = 0;
        for (int y = 0; y < 240; ++y) {
            for (int x = 0; x < 240; ++x)
                (y < 120 ? top : bottom) += p.at(x, y, 1);
        }
        return (top - bottom) / (120 * 240);
    };
    const double without = contrast(grow_plane(sample, o)->pixels);
    o.guide = PlaneGuide{target, known, 4.0f};
    const auto guided = grow_plane(sample, o);
    ASSERT_TRUE(guided);
    expect_sound(sample, *guided, o);
    EXPECT_GT(contrast(guided->pixels), without + 20);

    const Matte nothing(240, 240, 0);
    o.guide = PlaneGuide{target, nothing, 4.0f};
    EXPECT_NEAR(contrast(grow_plane(sample, o)->pixels), without, 15);
}

TEST(Refine, LowersTheEnergyAndStaysSound) {
    for (const bool tileable : {false, true}) {
        const ImageU8x3 sample = blob_sample(96, 96, 4);
        PlaneOptions o = sized(200, 220);
        o.tileable = tileable;
        o.refine_passes = 0;
        const auto once = grow_plane(sample, o);
        o.refine_passes = 1;
        const auto refined = grow_plane(sample, o);
        o.refine_passes = 3;
        const auto further = grow_plane(sample, o);
        ASSERT_TRUE(once && refined && further);
        expect_sound(sample, *refined, o);
        expect_sound(sample, *further, o);
        EXPECT_LT(refined->stats.seam_energy, once->stats.seam_energy);
        EXPECT_LE(further->stats.seam_energy, refined->stats.seam_energy);
    }
}

TEST(Refine, LeavesAPerfectPlaneAlone) {
    const ImageU8x3 bricks = brick_sample(96, 96, 24, 12);
    PlaneOptions o = sized(200, 200);
    o.refine_passes = 0;
    const auto once = grow_plane(bricks, o);
    o.refine_passes = 2;
    const auto refined = grow_plane(bricks, o);
    ASSERT_TRUE(once && refined);
    EXPECT_EQ(once->source, refined->source);
}

TEST(Refine, TinyPlanesAndSamplesAreFine) {
    for (const int side : {1, 2, 3, 5, 30}) {
        for (const bool tileable : {false, true}) {
            const ImageU8x3 sample = blob_sample(24, 30, 5);
            PlaneOptions o = sized(side, 2 * side);
            o.overlap_px = 12;
            o.tileable = tileable;
            o.refine_passes = 3;
            const auto plane = grow_plane(sample, o);
            ASSERT_TRUE(plane);
            expect_sound(sample, *plane, o);
        }
    }
}

TEST(Guide, MustFitThePlane) {
    const ImageU8x3 sample = blob_sample(96, 96, 3), target(100, 90, 0);
    const Matte known(100, 100, 0);
    PlaneOptions o = sized(100, 100);
    o.guide = PlaneGuide{target, known, 1.0f};
    const auto plane = grow_plane(sample, o);
    ASSERT_FALSE(plane);
    EXPECT_EQ(plane.error().code, ErrorCode::kUsage);
}

// Overlaps that grow for the period make bands so low that pieces reach over several of them.
TEST(Refinement, IsTheSameByAnyNumberOfThreadsWhereBandsAreLow) {
    ImageU8x3 lattice(96, 96);
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) {
            const int u = ((x + y) % 64 + 64) % 64, v = ((x - y) % 64 + 64) % 64;
            for (int c = 0; c < 3; ++c)
                lattice.at(x, y, c) = static_cast<std::uint8_t>(
                    60 + 2 * std::min(u, 64 - u) + std::min(v, 64 - v) * (c + 1) +
                    static_cast<int>(
                        Rng(7, static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y), 0)
                            .below(24)));
        }
    }
    PlaneOptions o;
    o.size = {512, 512};
    set_thread_count(1);
    const auto one = grow_plane(lattice, o);
    ASSERT_TRUE(one);
    EXPECT_GT(one->stats.period.count, 0);
    for (int round = 0; round < 4; ++round) {
        set_thread_count(2);
        const auto two = grow_plane(lattice, o);
        set_thread_count(0);
        ASSERT_TRUE(two);
        EXPECT_EQ(two->source, one->source);
        EXPECT_EQ(two->pixels, one->pixels);
    }
}

}  // namespace
}  // namespace weft::test

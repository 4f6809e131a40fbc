#include "engine/mask/edge_softening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/core/parallel.h"
#include "tests/mask/moving_disc.h"

namespace weft {
namespace {

using test::DiscScene;

// The true coverage of a slanted edge through a plate of two flat colours.
struct SlantedEdge {
    Size size{64, 48};
    ImageF1 coverage{size};
    ImageU8x3 plate{size};
    Matte ids{size};

    SlantedEdge(Vec3 inside, Vec3 outside, float noise, std::uint64_t seed = 0) {
        Rng rng(11, seed);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const float d = 30.3f + 0.27f * static_cast<float>(y) - static_cast<float>(x);
                const float a = std::min(std::max(0.5f + d * 0.965f, 0.0f), 1.0f);
                coverage.at(x, y) = a;
                ids.at(x, y) = a >= 0.5f ? 255 : 0;
                const Vec3 c = a * inside + (1 - a) * outside;
                for (int i = 0; i < 3; ++i) {
                    const auto n = noise * static_cast<float>(rng.uniform() * 2 - 1);
                    plate.at(x, y, i) = static_cast<std::uint8_t>(c[i] + n + 0.5f);
                }
            }
        }
    }
};

TEST(EdgeHardness, TellsIdMattesFromPaintedOnesAndGoesOverGradually) {
    const DiscScene scene;
    const Matte soft = scene.matte(0);
    Matte hard = soft;
    for (int y = 0; y < hard.height(); ++y) {
        for (int x = 0; x < hard.width(); ++x)
            hard.at(x, y) = hard.at(x, y) >= 128 ? 255 : 0;
    }
    EXPECT_EQ(edge_hardness(soft), 0);
    EXPECT_EQ(edge_hardness(hard), 1);
    EXPECT_EQ(edge_hardness(Matte(20, 20, 255)), 1);
    // As more and more stray pixels are partial, it never falls by much.
    float before = 1;
    for (int k = 0; k < 60; ++k) {
        hard.at(2 + 3 * (k % 20), 2 + 3 * (k / 20)) = 128;
        const float now = edge_hardness(hard);
        EXPECT_LE(now, before);
        EXPECT_GT(now, before - 0.06f);
        before = now;
    }
    EXPECT_LT(before, 1);
}

TEST(SoftenHardEdge, FindsTheTrueCoverageInside) {
    const SlantedEdge edge(Vec3(200, 160, 40), Vec3(40, 60, 90), 2);
    const Matte soft = soften_hard_edge(edge.plate, edge.ids);
    int mixed = 0;
    for (int y = 2; y < edge.size.height - 2; ++y) {
        for (int x = 2; x < edge.size.width - 2; ++x) {
            const float a = edge.coverage.at(x, y);
            if (edge.ids.at(x, y) == 0 || a >= 0.999f) continue;
            ++mixed;
            EXPECT_NEAR(soft.at(x, y) / 255.0f, a, 0.06f) << x << "," << y;
        }
    }
    EXPECT_GT(mixed, 20);
}

TEST(SoftenHardEdge, AddsNothingAndStaysInsideTheBand) {
    const SlantedEdge edge(Vec3(200, 160, 40), Vec3(40, 60, 90), 8);
    const Matte soft = soften_hard_edge(edge.plate, edge.ids, 1.5f);
    for (int y = 0; y < edge.size.height; ++y) {
        for (int x = 0; x < edge.size.width; ++x) {
            ASSERT_LE(soft.at(x, y), edge.ids.at(x, y));
            const float d = 30.3f + 0.27f * static_cast<float>(y) - static_cast<float>(x);
            if (d > 3) {
                ASSERT_EQ(soft.at(x, y), 255) << x << "," << y;
            }
        }
    }
}

TEST(SoftenHardEdge, CoverageRisesInwards) {
    const SlantedEdge edge(Vec3(200, 160, 40), Vec3(40, 60, 90), 0);
    const Matte soft = soften_hard_edge(edge.plate, edge.ids);
    for (int y = 2; y < edge.size.height - 2; ++y) {
        for (int x = 1; x < edge.size.width; ++x) {
            ASSERT_LE(soft.at(x, y), soft.at(x - 1, y) + 2) << x << "," << y;
        }
    }
}

// Alike colours tell nothing: the edge is that of the shape, not of the noise.
TEST(SoftenHardEdge, AlikeColoursLeaveTheShapesOwnEdge) {
    const SlantedEdge a(Vec3(100, 100, 100), Vec3(103, 101, 99), 5, 1);
    const SlantedEdge b(Vec3(100, 100, 100), Vec3(103, 101, 99), 5, 2);
    const Matte soft_a = soften_hard_edge(a.plate, a.ids),
                soft_b = soften_hard_edge(b.plate, b.ids);
    EXPECT_EQ(soft_a, soft_b);
    EXPECT_NE(soft_a, a.ids);
}

// Fresh noise in every frame may not make the edge flicker.
TEST(SoftenHardEdge, IsCalmUnderNoise) {
    for (const float contrast : {20.0f, 45.0f, 110.0f}) {
        const Vec3 inside(100 + contrast, 100, 90), outside(100, 100 + contrast * 0.3f, 90);
        double change = 0, n = 0;
        for (std::uint64_t t = 0; t < 6; ++t) {
            const SlantedEdge a(inside, outside, 4, 2 * t), b(inside, outside, 4, 2 * t + 1);
            const Matte p = soften_hard_edge(a.plate, a.ids), q = soften_hard_edge(b.plate, b.ids);
            for (int y = 0; y < a.size.height; ++y) {
                for (int x = 0; x < a.size.width; ++x) {
                    if (p.at(x, y) == a.ids.at(x, y) && q.at(x, y) == a.ids.at(x, y)) continue;
                    change += std::abs(p.at(x, y) - q.at(x, y));
                    n += 1;
                }
            }
        }
        EXPECT_LT(change / n, 20) << "levels of 255, at a contrast of " << contrast;
    }
}

TEST(SoftenHardEdge, IsTheSameOnAnyNumberOfThreads) {
    const SlantedEdge edge(Vec3(180, 120, 40), Vec3(40, 60, 90), 8);
    set_thread_count(1);
    const Matte one = soften_hard_edge(edge.plate, edge.ids);
    set_thread_count(3);
    const Matte three = soften_hard_edge(edge.plate, edge.ids);
    set_thread_count(0);
    EXPECT_EQ(one, three);
}

TEST(SoftenHardEdge, EmptyAndFullMattesStay) {
    const ImageU8x3 plate(30, 20, 90);
    EXPECT_EQ(soften_hard_edge(plate, Matte(30, 20)), Matte(30, 20));
    EXPECT_EQ(soften_hard_edge(plate, Matte(30, 20, 255)), Matte(30, 20, 255));
}

}  // namespace
}  // namespace weft

#include "engine/mask/matte_propagation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/core/parallel.h"
#include "tests/mask/moving_disc.h"

namespace weft {
namespace {

using test::DiscScene;
using test::overlap;

std::vector<MatteEstimate> walk_disc(const DiscScene& scene, int frames,
                                     float motion_error_px = 0) {
    std::vector<MatteEstimate> result;
    MatteWalker walker(scene.frame(0), scene.matte(0));
    for (int t = 1; t <= frames; ++t) {
        FlowField flow = scene.prev_from_cur(t);
        Rng rng(3, 0, static_cast<std::uint64_t>(t));
        for (int y = 0; y < scene.size.height; ++y) {
            for (int x = 0; x < scene.size.width; ++x) {
                if (motion_error_px <= 0) continue;
                flow.d.at(x, y, 0) += motion_error_px * static_cast<float>(rng.uniform() * 2 - 0.5);
                flow.valid.at(x, y) = rng.below(3) == 0 ? 255 : 0;
            }
        }
        result.push_back(walker.advance(scene.frame(t), flow));
    }
    return result;
}

TEST(MatteWalker, FollowsADiscForTwentyFrames) {
    const DiscScene scene;
    const auto mattes = walk_disc(scene, 20);
    EXPECT_GT(overlap(mattes.back().matte, scene.matte(20)), 0.97);
}

// The edge must not soften from frame to frame: as many partial pixels at the end as at the start.
TEST(MatteWalker, TheEdgeStaysAsSharpAsItWas) {
    const DiscScene scene;
    const auto mattes = walk_disc(scene, 20);
    const auto partial = [](const Matte& m) {
        int n = 0;
        for (int y = 0; y < m.height(); ++y) {
            for (int x = 0; x < m.width(); ++x)
                n += m.at(x, y) > 12 && m.at(x, y) < 243 ? 1 : 0;
        }
        return n;
    };
    EXPECT_LT(partial(mattes[19].matte), partial(mattes[0].matte) * 1.3);
    EXPECT_GT(partial(mattes[19].matte), 0);
}

TEST(MatteWalker, FollowsThroughTheBorderAndOut) {
    DiscScene scene;
    scene.start = Vec2(120, 60);
    scene.step = Vec2(6, 0);
    const auto mattes = walk_disc(scene, 14);
    EXPECT_GT(overlap(mattes[4].matte, scene.matte(5)), 0.95);  // half outside
    EXPECT_EQ(mattes.back().matte, Matte(scene.size));
    EXPECT_EQ(mattes.back().confidence, 0);
}

TEST(MatteWalker, AnEmptyKeyStaysEmpty) {
    const DiscScene scene;
    MatteWalker walker(scene.frame(0), Matte(scene.size));
    EXPECT_EQ(walker.advance(scene.frame(1), scene.prev_from_cur(1)).matte, Matte(scene.size));
}

TEST(MatteWalker, AFullKeyStaysFull) {
    const DiscScene scene;
    MatteWalker walker(scene.frame(0), Matte(scene.size, 255));
    EXPECT_EQ(walker.advance(scene.frame(1), scene.prev_from_cur(1)).matte, Matte(scene.size, 255));
}

TEST(MatteWalker, TheKeyIsNotWrittenTo) {
    const DiscScene scene;
    const Matte key = scene.matte(0);
    const Matte copy = key;
    MatteWalker walker(scene.frame(0), key);
    (void)walker.advance(scene.frame(1), scene.prev_from_cur(1));
    EXPECT_EQ(key, copy);
}

TEST(MatteWalker, ConfidenceFallsFasterUnderCorruptedMotion) {
    const DiscScene scene;
    const auto good = walk_disc(scene, 8);
    const auto bad = walk_disc(scene, 8, 6);
    for (std::size_t t = 1; t < good.size(); ++t) {
        EXPECT_LE(good[t].confidence, good[t - 1].confidence);
    }
    EXPECT_GT(good.back().confidence, bad.back().confidence + 0.1f);
    // The disc's colours make up for it: 0.97 before what has no past was judged by them.
    EXPECT_GT(overlap(bad.back().matte, scene.matte(8)), 0.99);
    EXPECT_GT(overlap(good.back().matte, scene.matte(8)), 0.99);
}

// Fresh noise in every frame: the held boundary wavers less against the true one, and is no further
// from it.
TEST(MatteWalker, SteadinessTakesBoilOut) {
    DiscScene scene;
    const auto boil = [&](float steadiness) {
        MatteWalker walker(scene.frame(0), scene.matte(0), {steadiness});
        Matte before = scene.matte(0);
        double change = 0, miss = 0;
        for (int t = 1; t <= 12; ++t) {
            ImageU8x3 frame = scene.frame(t, 9);
            Rng rng(21, 0, static_cast<std::uint64_t>(t));
            for (int y = 0; y < frame.height(); ++y) {
                for (int i = 0; i < 3 * frame.width(); ++i) {
                    const int noisy = frame.row(y)[i] + static_cast<int>(rng.below(61)) - 30;
                    frame.row(y)[i] = static_cast<std::uint8_t>(std::clamp(noisy, 0, 255));
                }
            }
            const Matte now = walker.advance(frame, scene.prev_from_cur(t)).matte;
            const Matte truth = scene.matte(t), was_truth = scene.matte(t - 1);
            for (int y = 0; y < now.height(); ++y) {
                for (int x = 0; x < now.width(); ++x) {
                    const int error = now.at(x, y) - truth.at(x, y);
                    change += std::abs(error - (before.at(x, y) - was_truth.at(x, y)));
                    miss += std::abs(error);
                }
            }
            before = now;
        }
        return std::pair(change, miss);
    };
    const auto loose = boil(0), held = boil(0.8f);
    EXPECT_LT(held.first, 0.9 * loose.first);
    EXPECT_LT(held.second, 1.1 * loose.second);
}

TEST(MatteWalker, GivesTheSameBytesOnAnyNumberOfThreads) {
    const DiscScene scene;
    set_thread_count(1);
    const auto one = walk_disc(scene, 3);
    set_thread_count(3);
    const auto three = walk_disc(scene, 3);
    set_thread_count(0);
    for (std::size_t t = 0; t < one.size(); ++t) {
        EXPECT_EQ(one[t].matte, three[t].matte);
        EXPECT_EQ(one[t].confidence, three[t].confidence);
    }
}

TEST(MergeEstimates, AKeyframesMatteIsReturnedAsItIs) {
    const DiscScene scene;
    const MatteEstimate before{scene.matte(0), 1}, after{scene.matte(9), 0.4f};
    EXPECT_EQ(merge_estimates(before, after, {0, 0, 9}, scene.frame(0)).matte, before.matte);
    EXPECT_EQ(merge_estimates(before, after, {9, 0, 9}, scene.frame(9)).matte, after.matte);
}

// Two estimates that miss the disc by some pixels on either side: the average of their alphas would
// have two half-transparent crescents; the merge finds the one edge between.
TEST(MergeEstimates, TwoDisplacedEdgesBecomeOne) {
    DiscScene left, right;
    const DiscScene scene;
    left.start.x -= 4;
    right.start.x += 4;
    const MatteEstimate merged =
        merge_estimates({left.matte(0), 0.8f}, {right.matte(0), 0.8f}, {1, 0, 2}, scene.frame(0));
    EXPECT_GT(overlap(merged.matte, scene.matte(0)), 0.96);
    int ghosts = 0;  // partial pixels far from the true edge
    for (int y = 0; y < scene.size.height; ++y) {
        for (int x = 0; x < scene.size.width; ++x) {
            const float d = glm::length(Vec2(x, y) - scene.center(0)) - scene.radius_px;
            const int m = merged.matte.at(x, y);
            ghosts += std::abs(d) > 3.5f && m > 25 && m < 230 ? 1 : 0;
        }
    }
    EXPECT_LT(ghosts, 12);
}

// One walk has taken a block of the ground, which looks like the disc to the cut; over the clip it
// was found to be outside.
TEST(MergeEstimates, WhatIsDecidedOverTheClipStays) {
    const DiscScene scene;
    MatteEstimate before{scene.matte(0), 0.9f};
    const MatteEstimate after{scene.matte(0), 0.5f};
    const Vec2i center(scene.center(0));
    const auto radius = static_cast<int>(scene.radius_px);
    const Recti block{center.x - radius - 14, center.y - 6, center.x - radius, center.y + 6};
    ImageU8x3 frame = scene.frame(0);
    for (int y = block.y0; y < block.y1; ++y) {
        for (int x = block.x0; x < block.x1; ++x) {
            before.matte.at(x, y) = 255;
            std::copy_n(frame.pixel(center.x, center.y), 3, frame.pixel(x, y));
        }
    }
    const auto taken = [&](float inside) {
        const ImageF1 decided(scene.size, inside);
        const Matte merged =
            merge_estimates(before, after, {1, 0, 2}, frame, {}, {}, decided).matte;
        return merged.at(block.x0 + 5, center.y);
    };
    EXPECT_LT(taken(0.1f), 30);
    EXPECT_GT(taken(0.9f), 225);
}

TEST(MergeEstimates, TheSurerEstimateDecides) {
    const DiscScene scene;
    DiscScene wrong = scene;
    wrong.start += Vec2(9, 5);
    const MatteEstimate merged =
        merge_estimates({scene.matte(0), 0.9f}, {wrong.matte(0), 0.1f}, {1, 0, 2}, scene.frame(0));
    EXPECT_GT(overlap(merged.matte, scene.matte(0)), 0.96);
    EXPECT_LT(merged.confidence, 0.95f);
}

}  // namespace
}  // namespace weft

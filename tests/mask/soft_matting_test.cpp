#include "engine/mask/soft_matting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/core/rng.h"
#include "engine/mask/edge_alpha.h"
#include "engine/mask/matte_propagation.h"
#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr Size kSize{140, 120};

// A round head of brown hair, 18 px in radius, whose strands stand out by up to 9 px, over a
// smooth background. Everything that belongs to it moves by `step` a frame.
struct Head {
    Vec2 start{60, 60}, step{1.7f, 0.6f};

    [[nodiscard]] Vec2 centre(int t) const { return start + static_cast<float>(t) * step; }

    // Whether a point of the head, from its centre, is hair.
    [[nodiscard]] static bool is_hair(Vec2 p) {
        const float r = glm::length(p);
        if (r < 18) return true;
        constexpr int kStrands = 60;
        const float turn = (std::atan2(p.y, p.x) / 6.2831853f + 0.5f) * kStrands;
        const int strand = static_cast<int>(std::floor(turn)) % kStrands;
        Rng rng(11, 0, static_cast<std::uint64_t>(strand));
        const float length = 4 + 5 * static_cast<float>(rng.uniform());
        const float off = 0.3f + 0.4f * static_cast<float>(rng.uniform());
        const float across = std::abs(turn - std::floor(turn) - off) * 6.2831853f * r / kStrands;
        return r < 18 + length && across < 0.9f * (1 - (r - 18) / (length + 2));
    }
    [[nodiscard]] ImageF1 alpha(int t) const {
        ImageF1 out(kSize);
        for (int y = 0; y < kSize.height; ++y) {
            for (int x = 0; x < kSize.width; ++x) {
                int n = 0;
                for (int k = 0; k < 16; ++k) {
                    const Vec2 p(static_cast<float>(x) + (static_cast<float>(k % 4) + 0.5f) / 4,
                                 static_cast<float>(y) + (static_cast<float>(k / 4) + 0.5f) / 4);
                    n += is_hair(p - centre(t)) ? 1 : 0;
                }
                out.at(x, y) = static_cast<float>(n) / 16;
            }
        }
        return out;
    }
    [[nodiscard]] Matte matte(int t) const {
        const ImageF1 a = alpha(t);
        Matte out(kSize);
        std::transform(a.data(), a.data() + kSize.width * kSize.height, out.data(),
                       [](float v) { return static_cast<std::uint8_t>(v * 255 + 0.5f); });
        return out;
    }
    [[nodiscard]] ImageU8x3 frame(int t) const {
        const ImageF1 a = alpha(t);
        ImageU8x3 out(kSize);
        Rng rng(5, 0, static_cast<std::uint64_t>(t));
        for (int y = 0; y < kSize.height; ++y) {
            for (int x = 0; x < kSize.width; ++x) {
                const Vec2 p = Vec2(x, y) - centre(t);
                const Vec3 hair = Vec3(120, 78, 40) + 18 * std::sin(0.8f * p.x + 0.3f * p.y);
                const Vec3 sky = Vec3(120 + 0.4f * static_cast<float>(y), 160, 205) +
                                 8 * std::sin(0.15f * static_cast<float>(x));
                for (int c = 0; c < 3; ++c) {
                    const float mixed = a.at(x, y) * hair[c] + (1 - a.at(x, y)) * sky[c];
                    out.at(x, y, c) = static_cast<std::uint8_t>(
                        mixed + static_cast<float>(rng.uniform() * 3 - 1));
                }
            }
        }
        return out;
    }
    [[nodiscard]] FlowField prev_from_cur(int t) const {
        FlowField f(kSize);
        for (int y = 0; y < kSize.height; ++y) {
            for (int x = 0; x < kSize.width; ++x) {
                const bool on_it = glm::length(Vec2(x, y) - centre(t)) < 22;
                f.d.at(x, y, 0) = on_it ? -step.x : 0;
                f.d.at(x, y, 1) = on_it ? -step.y : 0;
                if (!on_it && glm::length(Vec2(x, y) - centre(t - 1)) < 27) f.valid.at(x, y) = 0;
            }
        }
        return f;
    }
};

// Mean error of coverage, in levels, where either of two mattes is soft.
double edge_error(const Matte& found, const Matte& truth) {
    double sum = 0, n = 0;
    for (int y = 0; y < truth.height(); ++y) {
        for (int x = 0; x < truth.width(); ++x) {
            const int a = found.at(x, y), b = truth.at(x, y);
            const bool soft = (a > 5 && a < 250) || (b > 5 && b < 250) || std::abs(a - b) > 128;
            if (!soft) continue;
            sum += std::abs(a - b);
            n += 1;
        }
    }
    return n > 0 ? sum / n : 0;
}

ImageF1 phi_of(const Matte& matte) {
    return smooth_distance(signed_distance(inside_of(matte), 40), 1);
}

TEST(EdgeSoftness, IsWideWhereHairIsAndNarrowAtAnAntialiasedEdge) {
    const Matte hair = Head().matte(0);
    const ImageF1 phi = phi_of(hair);
    const ImageF1 wide = edge_softness(hair, shape_without_strands(phi, 40), 20);
    EXPECT_GT(wide.at(60, 38), 3);
    EXPECT_LT(wide.at(60, 38), 11);
    const ImageF1 round = shape_without_strands(phi, 40);
    const Matte smooth = edge_alpha(Head().frame(0), round, 1.0f);
    EXPECT_EQ(edge_softness(smooth, round, 20).at(60, 38), 0);
    // Far away what is nearest goes on.
    EXPECT_GT(wide.at(139, 119), 3);
}

TEST(SoftAlpha, FollowsStrandsThatACrispEdgeLoses) {
    const Head head;
    const Matte truth = head.matte(0);
    const ImageU8x3 frame = head.frame(0);
    const ImageF1 phi = phi_of(truth);
    const Matte crisp = edge_alpha(frame, phi, 1.5f);
    const Matte soft = with_soft_edges(
        frame, phi, edge_softness(truth, shape_without_strands(phi, 40), 20), crisp, {}, 0.5f);
    RecordProperty("crisp", std::to_string(edge_error(crisp, truth)));
    RecordProperty("soft", std::to_string(edge_error(soft, truth)));
    EXPECT_LT(edge_error(soft, truth), 0.45 * edge_error(crisp, truth));
}

TEST(SoftAlpha, LeavesACrispMatteAsItIs) {
    const Head head;
    const ImageU8x3 frame = head.frame(0);
    const ImageF1 phi = shape_without_strands(phi_of(head.matte(0)), 40);
    const Matte crisp = edge_alpha(frame, phi, 1.0f);
    EXPECT_EQ(with_soft_edges(frame, phi, edge_softness(crisp, phi, 20), crisp, {}, 0.5f), crisp);
}

// Walks eight frames from a painted matte with and without the keyframe's soft edge.
TEST(SoftAlpha, IsPropagatedFromThePaintedFrame) {
    const Head head;
    const Matte painted = head.matte(0);
    Matte hard = painted;
    for (int y = 0; y < hard.height(); ++y) {
        for (int x = 0; x < hard.width(); ++x)
            hard.at(x, y) = painted.at(x, y) >= 128 ? 255 : 0;
    }
    MatteWalker soft_walk(head.frame(0), painted), hard_walk(head.frame(0), hard);
    double soft = 0, crisp = 0, change = 0, crisp_change = 0;
    Matte last = painted, last_crisp = hard, last_truth = painted;
    for (int t = 1; t <= 8; ++t) {
        const Matte a = soft_walk.advance(head.frame(t), head.prev_from_cur(t)).matte;
        const Matte b = hard_walk.advance(head.frame(t), head.prev_from_cur(t)).matte;
        const Matte truth = head.matte(t);
        soft += edge_error(a, truth) / 8;
        crisp += edge_error(b, truth) / 8;
        for (int y = 0; y < truth.height(); ++y) {
            for (int x = 0; x < truth.width(); ++x) {
                const int true_change = truth.at(x, y) - last_truth.at(x, y);
                change += std::abs(a.at(x, y) - last.at(x, y) - true_change);
                crisp_change += std::abs(b.at(x, y) - last_crisp.at(x, y) - true_change);
            }
        }
        last = a, last_crisp = b, last_truth = truth;
    }
    RecordProperty("soft", std::to_string(soft));
    RecordProperty("crisp", std::to_string(crisp));
    RecordProperty("change", std::to_string(change / crisp_change));
    EXPECT_LT(soft, 0.55 * crisp);
    EXPECT_LT(change, 0.8 * crisp_change) << "and it boils less against the true one";
}

TEST(SoftAlpha, IsTheSameOnAnyNumberOfThreads) {
    const Head head;
    const ImageF1 phi = phi_of(head.matte(0));
    const ImageF1 softness = edge_softness(head.matte(0), shape_without_strands(phi, 40), 20);
    const ImageU8x3 frame = head.frame(0);
    set_thread_count(1);
    const Matte one = with_soft_edges(frame, phi, softness, Matte(kSize), {}, 0.5f);
    set_thread_count(3);
    const Matte three = with_soft_edges(frame, phi, softness, Matte(kSize), {}, 0.5f);
    set_thread_count(0);
    EXPECT_EQ(one, three);
}

}  // namespace
}  // namespace weft

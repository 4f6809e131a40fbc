// Shapes from the motion of what is rigid.
#include "engine/form/rigid_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "engine/core/rng.h"
#include "tests/form/surfaces.h"

namespace weft {
namespace {

// A camera that has moved by `shift` and turned about the upright axis by `turn` (radians).
struct View {
    Vec3 shift{0};
    float turn = 0;

    [[nodiscard]] Vec2 seen(Vec3 place) const {
        const Vec3 p = place - shift;
        const float c = std::cos(turn), s = std::sin(turn);
        const Vec3 q(c * p.x - s * p.z, p.y, s * p.x + c * p.z);
        return {160 + kFocal_px * q.x / q.z, 120 + kFocal_px * q.y / q.z};
    }
};

using Hit = std::function<float(Vec3)>;

// What the views show of a surface, with errors of `noise_px` that are alike in a neighbourhood.
std::vector<FrameMatches> matches(const Hit& hit, const std::vector<View>& views, double noise_px) {
    const Surface surface = seen(hit);
    std::vector<FrameMatches> out;
    for (std::size_t v = 0; v < views.size(); ++v) {
        FrameMatches m;
        for (int y = 4; y < kSize.height; y += 24) {
            for (int x = 4; x < kSize.width; x += 24) {
                if (surface.matte.at(x, y) == 0) continue;
                const float* p = surface.place.pixel(x, y);
                Rng random(7, 0, v, static_cast<std::uint64_t>(y / 72 * 100 + x / 72));
                const auto error = [&] {
                    return static_cast<float>(noise_px * (2 * random.uniform() - 1));
                };
                m.reference.push_back({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
                m.frame.push_back(views[v].seen({p[0], p[1], p[2]}) + Vec2(error(), error()));
            }
        }
        out.push_back(std::move(m));
    }
    return out;
}

// A camera that goes round what it looks at, at a distance.
std::vector<View> round_about(float distance, float most) {
    std::vector<View> out;
    for (const float share : {-1.0f, -0.6f, -0.3f, 0.3f, 0.6f, 1.0f}) {
        const float a = share * most;
        out.push_back(
            {Vec3(distance * std::sin(a), 0.3f * share, distance * (1 - std::cos(a))), a});
    }
    return out;
}

double stretch_left(const Hit& hit, const RigidSurface& found) {
    const Surface surface = seen(hit);
    std::vector<double> all;
    for (int y = 8; y < kSize.height - 8; y += 8) {
        for (int x = 8; x < kSize.width - 8; x += 8) {
            if (surface.matte.at(x, y) == 0 || surface.matte.at(x + 1, y) == 0 ||
                surface.matte.at(x, y + 1) == 0)
                continue;
            const auto place = [&](int i, int j) {
                const float* p = surface.place.pixel(i, j);
                return Vec3(p[0], p[1], p[2]);
            };
            const Vec3 a = place(x + 1, y) - place(x, y), b = place(x, y + 1) - place(x, y);
            const auto dot = [](Vec3 u, Vec3 v) { return u.x * v.x + u.y * v.y + u.z * v.z; };
            const double gxx = dot(a, a), gxy = dot(a, b), gyy = dot(b, b);
            const Metric m =
                found.metric({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
            const double area = m.determinant();
            const double half = (m.yy * gxx - 2 * m.xy * gxy + m.xx * gyy) / (2 * area);
            const double root =
                std::sqrt(std::max(0.0, half * half - (gxx * gyy - gxy * gxy) / area));
            all.push_back(std::sqrt((half + root) / (half - root)));
        }
    }
    std::sort(all.begin(), all.end());
    return all[all.size() / 2];
}

std::optional<RigidFit> fit(const Hit& hit, const std::vector<View>& views,
                            double noise_px = 0.05) {
    return fit_rigid_surface(matches(hit, views, noise_px), kSize, std::nullopt);
}

float column(Vec3 r) {
    return sphere(r, {0, 0, 4}, 1, {1, 0, 1});
}

TEST(RigidFit, AFloorIsFoundWithTheFieldOfView) {
    const auto found = fit(floor_below, round_about(4, 0.1f));
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->plane);
    EXPECT_NEAR(found->fov_deg, 56.1, 2);
    EXPECT_GT(found->belief(), 0.98);
    EXPECT_LT(found->tilt_error_deg, 2);
    EXPECT_LT(stretch_left(floor_below, found->surface), 1.03);
}

TEST(RigidFit, AColumnIsCurved) {
    const auto found = fit(column, round_about(4, 0.2f));
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->plane);
    EXPECT_GT(found->belief(), 0.95);
    EXPECT_LT(stretch_left(column, found->surface), 1.02);
}

// The less the view turns, the larger the error, and the less of the form is believed.
TEST(RigidFit, TheErrorIsAsLargeAsTheMotionIsSmall) {
    double before = 1e9;
    for (const float turn : {0.02f, 0.05f, 0.1f, 0.2f, 0.3f}) {
        const auto found = fit(floor_below, round_about(4, turn));
        ASSERT_TRUE(found);
        EXPECT_LT(found->error, before) << turn;
        before = found->error;
    }
    EXPECT_LT(before, 0.01);
}

// It turns about its own place, and all surfaces move alike.
TEST(RigidFit, APanShowsNoForm) {
    std::vector<View> pan;
    for (const float turn : {-0.2f, -0.1f, 0.1f, 0.2f})
        pan.push_back({Vec3(0), turn});
    EXPECT_FALSE(fit(floor_below, pan));
}

// A lens that zooms out while it pans looks like a camera that moves away from a wall, and
// distortion like parallax: neither may be taken for the form of a floor.
TEST(RigidFit, APanWithAZoomShowsNoForm) {
    std::vector<View> pan;
    for (const float turn : {-0.15f, -0.1f, -0.05f, 0.05f, 0.1f, 0.2f})
        pan.push_back({Vec3(0), turn});
    std::vector<FrameMatches> seen = matches(floor_below, pan, 0.05);
    const auto distorted = [](Vec2 p, float zoom) {
        constexpr float kBarrel = -0.02f;  // of the distance at the left and right edge
        const Vec2 from = zoom * (p - Vec2(160, 120));
        return Vec2(160, 120) + (1 + kBarrel * (from.x * from.x + from.y * from.y) / 25600) * from;
    };
    for (std::size_t k = 0; k < seen.size(); ++k) {
        for (Vec2& p : seen[k].reference)
            p = distorted(p, 1);
        for (Vec2& p : seen[k].frame)
            p = distorted(p, 1 - 0.04f * static_cast<float>(k));
    }
    const auto found = fit_rigid_surface(seen, kSize, std::nullopt);
    EXPECT_FALSE(found) << found->belief() << ' ' << found->tilt_deg;
}

TEST(RigidFit, AStillPictureShowsNoForm) {
    EXPECT_FALSE(fit(floor_below, {{}, {}, {}}, 0.1));
}

// A cloth whose waves run through it.
TEST(RigidFit, WhatBendsIsNotRigid) {
    std::vector<FrameMatches> frames;
    for (int t = 1; t <= 6; ++t) {
        FrameMatches m;
        for (int y = 20; y < 220; y += 24) {
            for (int x = 40; x < 280; x += 24) {
                m.reference.push_back({static_cast<float>(x), static_cast<float>(y)});
                const float wave =
                    6 * std::sin(0.05f * static_cast<float>(x) + 1.3f * static_cast<float>(t));
                m.frame.push_back(
                    {static_cast<float>(x) + wave, static_cast<float>(y) + 0.5f * wave});
            }
        }
        frames.push_back(std::move(m));
    }
    const auto found = fit_rigid_surface(frames, kSize, std::nullopt);
    EXPECT_TRUE(!found || found->belief() < 0.5) << found->belief() << ' ' << found->residual_px;
}

TEST(RigidFit, TooFewMatchesAreNoEvidence) {
    EXPECT_FALSE(fit_rigid_surface({}, kSize, std::nullopt));
    std::vector<FrameMatches> few = matches(floor_below, round_about(4, 0.1f), 0);
    for (FrameMatches& m : few)
        m.reference.resize(5), m.frame.resize(5);
    EXPECT_FALSE(fit_rigid_surface(few, kSize, std::nullopt));
}

// The floor knows the lens better than a wall that hardly turns; together they know it best.
TEST(RigidFit, TheMotionsOwnShareOfTheLensIsTold) {
    const auto floor = fit(floor_below, round_about(4, 0.2f));
    ASSERT_TRUE(floor);
    const auto own = floor->measured_tangent();
    ASSERT_TRUE(own);
    EXPECT_NEAR(own->value, 320 / kFocal_px, 0.05);
    EXPECT_LT(own->deviation, 0.1);
    EXPECT_GT(floor->fov_error_deg, 0);
    EXPECT_LT(floor->fov_error_deg, 4);
    const auto given = fit_rigid_surface(matches(floor_below, round_about(4, 0.2f), 0.05), kSize,
                                         TangentBelief{320 / kFocal_px, 0.01});
    ASSERT_TRUE(given);
    EXPECT_LT(given->error, floor->error);
    EXPECT_LT(given->fov_error_deg, floor->fov_error_deg);
}

TEST(SharedTangent, TheBestDeterminedDecide) {
    const auto shared = shared_tangent({{1.0, 0.01}, {1.3, 0.3}, {1.05, 0.1}});
    ASSERT_TRUE(shared);
    EXPECT_NEAR(shared->value, 1.01, 0.02);
    EXPECT_LT(shared->deviation, 0.05);
}

TEST(SharedTangent, OneAloneOrContradictionsShareNothing) {
    EXPECT_FALSE(shared_tangent({}));
    EXPECT_FALSE(shared_tangent({{1.0, 0.01}}));
    EXPECT_FALSE(shared_tangent({{0.7, 0.02}, {1.2, 0.02}})) << "as where the lens zooms";
}

}  // namespace
}  // namespace weft

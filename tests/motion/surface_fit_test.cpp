#include "engine/motion/surface_fit.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kFittedFrame{320, 200};
using Motion = std::function<Vec2(Vec2)>;

float gaussian(Rng& rng) {
    const double r = std::sqrt(-2 * std::log(1 - rng.uniform()));
    return static_cast<float>(r * std::cos(2 * std::numbers::pi * rng.uniform()));
}

// `truth` with Gaussian noise of `noise_px` and a share of outliers of up to 15 px.
ImageF2 observed(const Motion& truth, float noise_px, double outliers) {
    Rng rng(11);
    ImageF2 flow(kFittedFrame);
    for (int y = 0; y < kFittedFrame.height; ++y) {
        for (int x = 0; x < kFittedFrame.width; ++x) {
            const Vec2 d = truth(centre_of(x, y));
            const bool wrong = rng.uniform() < outliers;
            float* f = flow.pixel(x, y);
            for (int c = 0; c < 2; ++c) {
                const float off = noise_px * gaussian(rng);
                const auto anything = static_cast<float>(30 * rng.uniform() - 15);
                f[c] = wrong ? anything : d[c] + off;
            }
        }
    }
    return flow;
}

struct Errors {
    float mean = 0, worst = 0;
};

Errors errors(const LatticeField& field, const Motion& truth, const Recti& area) {
    Errors out;
    const ImageF2 dense = field.dense(area);
    for (int y = 0; y < area.height(); ++y) {
        for (int x = 0; x < area.width(); ++x) {
            const float* d = dense.pixel(x, y);
            const float e = distance({d[0], d[1]}, truth(centre_of(area.x0 + x, area.y0 + y)));
            out.mean += e;
            out.worst = std::max(out.worst, e);
        }
    }
    out.mean /= static_cast<float>(area.width() * area.height());
    return out;
}

Vec2 affine_motion(Vec2 p) {
    return {4.0f + 0.02f * p.x - 0.01f * p.y, -2.0f + 0.015f * p.x + 0.01f * p.y};
}

Vec2 quadratic_motion(Vec2 p) {
    const Vec2 q = (p - Vec2(160, 100)) / 160.0f;
    return affine_motion(p) + Vec2(2.0f * q.x * q.x - q.x * q.y, 1.5f * q.y * q.y + q.x * q.y);
}

const Matte kEverywhere(kFittedFrame, 255);

TEST(SurfaceFit, FindsSmoothMotionThroughNoiseAndOutliers) {
    for (const Motion& truth : {Motion(affine_motion), Motion(quadratic_motion)}) {
        const LatticeField field = fit_surface_motion(observed(truth, 0.3f, 0.2), kEverywhere, {});
        EXPECT_EQ(field.full_size(), kFittedFrame);
        const Errors e = errors(field, truth, rect_of(kFittedFrame));
        EXPECT_LT(e.mean, 0.03f);
        EXPECT_LT(e.worst, 0.15f);
    }
}

TEST(SurfaceFit, FollowsExactMotionClosely) {
    SurfaceFitOptions options;
    options.correlation_px = 1;
    options.noise_floor_px = 0.005f;
    const Motion truth = [](Vec2 p) {
        return affine_motion(p) + Vec2(std::sin(p.x / 15), std::cos(p.y / 12));
    };
    EXPECT_LT(errors(fit_surface_motion(observed(truth, 0, 0), kEverywhere, options), truth,
                     rect_of(kFittedFrame).grown(-8))
                  .mean,
              0.12f);  // of waves of 0.9 px on average
}

TEST(SurfaceFit, FollowsTheFoldsOfCloth) {
    const Motion cloth = [](Vec2 p) {
        return affine_motion(p) +
               Vec2(2.0f * std::sin(p.x / 18), 1.5f * std::sin(p.y / 16 + p.x / 40));
    };
    const Errors e = errors(fit_surface_motion(observed(cloth, 0.3f, 0.05), kEverywhere, {}), cloth,
                            rect_of(kFittedFrame).grown(-10));
    EXPECT_LT(e.mean, 0.25f);  // the folds themselves are 1.9 px on average
}

TEST(SurfaceFit, FollowsABumpOfCloth) {
    const Vec2 top(150, 100);
    const Motion bump = [&](Vec2 p) {
        const float r = distance(p, top) / 60.0f;
        return affine_motion(p) + Vec2(0, -4.0f * std::exp(-0.5f * r * r));
    };
    const LatticeField field = fit_surface_motion(observed(bump, 0.3f, 0.05), kEverywhere, {});
    EXPECT_LT(distance(field.at(top), bump(top)), 0.4f);
    EXPECT_LT(errors(field, bump, rect_of(kFittedFrame)).mean, 0.2f);
}

TEST(SurfaceFit, DoesNotFollowAMovingShadow) {
    // A tenth of the surface seems to move 3 px further.
    const Recti shadow{60, 60, 140, 140};
    const Motion seen = [&](Vec2 p) {
        const bool in = shadow.contains(static_cast<int>(p.x), static_cast<int>(p.y));
        return affine_motion(p) + (in ? Vec2(3, 0) : Vec2(0));
    };
    const LatticeField field = fit_surface_motion(observed(seen, 0.15f, 0), kEverywhere, {});
    EXPECT_LT(errors(field, affine_motion, shadow).mean, 0.3f);
    EXPECT_LT(errors(field, affine_motion, rect_of(kFittedFrame)).mean, 0.1f);
}

TEST(SurfaceFit, GoesOnBehindAHoleAndBeyondTheRegion) {
    // A character in front, and only the left part of the frame is the surface.
    const Recti hole{90, 50, 150, 140};
    const Motion seen = [&](Vec2 p) {
        const bool in = hole.contains(static_cast<int>(p.x), static_cast<int>(p.y));
        return in || p.x > 240 ? Vec2(-9, 7) : affine_motion(p);
    };
    Matte weights(kFittedFrame, 255);
    for (int y = 0; y < kFittedFrame.height; ++y) {
        for (int x = 0; x < kFittedFrame.width; ++x) {
            if (hole.contains(x, y) || x >= 240) weights.at(x, y) = 0;
        }
    }
    const LatticeField field = fit_surface_motion(observed(seen, 0.2f, 0.05), weights, {});
    EXPECT_LT(errors(field, affine_motion, hole).worst, 0.15f);
    EXPECT_LT(errors(field, affine_motion, {240, 20, 300, 180}).worst, 0.3f);
}

TEST(SurfaceFit, WithoutWeightThereIsNoMotion) {
    const LatticeField field =
        fit_surface_motion(observed(affine_motion, 0, 0), Matte(kFittedFrame), {});
    EXPECT_EQ(field.full_size(), kFittedFrame);
    EXPECT_EQ(field.nodes(), LatticeField(kFittedFrame, SurfaceFitOptions{}.spacing_px).nodes());
}

TEST(SurfaceFit, LeavesOutMotionThatIsNotANumber) {
    ImageF2 flow = observed(affine_motion, 0.1f, 0);
    for (int y = 20; y < 60; ++y) {
        for (int x = 20; x < 90; ++x)
            flow.at(x, y, x % 2) = std::numeric_limits<float>::quiet_NaN();
    }
    EXPECT_LT(
        errors(fit_surface_motion(flow, kEverywhere, {}), affine_motion, rect_of(kFittedFrame))
            .worst,
        0.15f);
}

TEST(SurfaceFit, TakesTheSmallestRegions) {
    const ImageF2 flow(8, 8, 2.0f);
    const LatticeField tiny = fit_surface_motion(flow, Matte(8, 8, 255), {});
    EXPECT_LT(distance(tiny.at({4, 4}), {2, 2}), 0.05f);
    Matte dot(8, 8);
    dot.at(3, 3) = 255;
    const Vec2 d = fit_surface_motion(flow, dot, {}).at({4, 4});
    EXPECT_TRUE(std::isfinite(d.x) && std::isfinite(d.y));
}

}  // namespace
}  // namespace weft

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

constexpr double kTangent = 320 / 300.0;

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

TEST(RigidFit, AFloorIsFoundFromACameraThatMoves) {
    const auto fit = fit_rigid_surface(
        matches(floor_below,
                {{{0.2f, 0, 0}, 0.05f}, {{0.4f, 0, 0.1f}, 0.1f}, {{0.7f, 0, 0.2f}, 0.15f}}, 0.05),
        kSize, std::nullopt);
    ASSERT_TRUE(fit);
    EXPECT_TRUE(fit->plane);
    std::printf(
        "floor: belief %.3f error %.3f stretch %.3f tilt %.1f +- %.1f fov %.1f turn %.1f left "
        "%.3f\n",
        fit->belief(), fit->error, fit->log_stretch, fit->tilt_deg, fit->tilt_error_deg,
        fit->fov_deg, fit->turn_deg, stretch_left(floor_below, fit->surface));
}

TEST(RigidFit, AColumn) {
    const Hit column = [](Vec3 r) { return sphere(r, {0, 0, 4}, 1, {1, 0, 1}); };
    for (const float turn : {0.05f, 0.1f, 0.2f, 0.3f}) {
        const auto fit =
            fit_rigid_surface(matches(column, round_about(4, turn), 0.05), kSize, std::nullopt);
        if (!fit) {
            std::printf("column %.2f: nothing\n", turn);
            continue;
        }
        std::printf(
            "column %.2f: plane %d belief %.3f error %.3f stretch %.3f tilt %.1f +- %.1f fov %.1f "
            "turn %.1f residual %.3f left %.3f\n",
            turn, fit->plane, fit->belief(), fit->error, fit->log_stretch, fit->tilt_deg,
            fit->tilt_error_deg, fit->fov_deg, fit->turn_deg, fit->residual_px,
            stretch_left(column, fit->surface));
    }
}

TEST(RigidFit, Turns) {
    for (const float turn : {0.0f, 0.02f, 0.05f, 0.1f, 0.2f, 0.3f}) {
        const auto fit = fit_rigid_surface(matches(floor_below, round_about(4, turn), 0.05), kSize,
                                           std::nullopt);
        if (!fit) {
            std::printf("floor %.2f: nothing\n", turn);
            continue;
        }
        std::printf(
            "floor %.2f: plane %d belief %.3f error %.3f stretch %.3f tilt %.1f +- %.1f fov %.1f "
            "turn %.1f residual %.3f left %.3f\n",
            turn, fit->plane, fit->belief(), fit->error, fit->log_stretch, fit->tilt_deg,
            fit->tilt_error_deg, fit->fov_deg, fit->turn_deg, fit->residual_px,
            stretch_left(floor_below, fit->surface));
    }
    std::vector<View> pan;
    for (const float a : {-0.2f, -0.1f, 0.1f, 0.2f})
        pan.push_back({Vec3(0), a});
    const auto fit = fit_rigid_surface(matches(floor_below, pan, 0.05), kSize, std::nullopt);
    if (fit)
        std::printf("pan: plane %d belief %.3f error %.3f stretch %.3f fov %.1f\n", fit->plane,
                    fit->belief(), fit->error, fit->log_stretch, fit->fov_deg);
}

}  // namespace
}  // namespace weft

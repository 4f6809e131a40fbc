#include "engine/mask/motion_sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr int kEvery = 3;            // pixels, in both directions
constexpr float kInside_px = 2;      // motion at the boundary is mixed
constexpr std::size_t kFewest = 60;  // samples
constexpr int kRounds = 8;
constexpr float kExact_px = 0.1f;                       // residuals below this weigh alike
constexpr float kClose_px = 0.7f, kCloseShare = 0.05f;  // of the motion: moves as the piece does
// The share that does: of a waving cloth 0.6 to 0.8, of a pillar, a wall or a car nearly all.
constexpr float kBent = 0.8f, kStiff = 0.95f;
constexpr float kTogether_px = 0.8f, kApart_px = 2;  // between both motions
constexpr float kMemory = 0.9f;                      // of the evidence, from frame to frame

struct Sample {
    Vec2 p, d;
};

// An affine motion d = a + b x + c y about a centre, px.
struct Affine {
    std::array<Vec2, 3> of{};
    Vec2 centre{0, 0};
    float scale = 1;
    [[nodiscard]] Vec2 at(Vec2 p) const {
        const Vec2 q = (p - centre) / scale;
        return of[0] + q.x * of[1] + q.y * of[2];
    }
};

std::vector<Sample> samples_inside(const SidesInput& in) {
    std::vector<Sample> out;
    for (int y = in.area.y0; y < in.area.y1; y += kEvery) {
        for (int x = in.area.x0; x < in.area.x1; x += kEvery) {
            if (in.flow.valid.row(y)[x] == 0) continue;
            const float* d = in.flow.d.pixel(x, y);
            const Vec2 p(static_cast<float>(x), static_cast<float>(y));
            if (sample_bilinear(in.prev_phi, p.x + d[0], p.y + d[1]) < kInside_px * in.unit_px)
                continue;
            out.push_back({p, Vec2(d[0], d[1])});
        }
    }
    return out;
}

float median_of(std::vector<float> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// Iteratively reweighted least squares with Cauchy weights.
Affine fit_affine(const std::vector<Sample>& samples, const Recti& area, float least_px) {
    Affine fit;
    fit.centre =
        Vec2(static_cast<float>(area.x0 + area.x1), static_cast<float>(area.y0 + area.y1)) * 0.5f;
    fit.scale = static_cast<float>(std::max(area.width(), area.height())) * 0.5f;
    std::vector<float> left(samples.size(), 0.0f);
    std::array<std::vector<float>, 2> channel;
    for (const Sample& s : samples)
        channel[0].push_back(s.d.x), channel[1].push_back(s.d.y);
    fit.of[0] = Vec2(median_of(channel[0]), median_of(channel[1]));
    for (int round = 0; round < kRounds; ++round) {
        for (std::size_t k = 0; k < samples.size(); ++k)
            left[k] = glm::length(samples[k].d - fit.at(samples[k].p));
        const float spread = std::max(least_px, 1.5f * median_of(left));
        cv::Matx33d a = cv::Matx33d::eye() * 1e-3;
        cv::Matx<double, 3, 2> b = cv::Matx<double, 3, 2>::zeros();
        for (std::size_t k = 0; k < samples.size(); ++k) {
            const double r = static_cast<double>(left[k] / spread), w = 1 / (1 + r * r);
            const Vec2 q = (samples[k].p - fit.centre) / fit.scale;
            const cv::Vec3d row(1, static_cast<double>(q.x), static_cast<double>(q.y));
            a += w * row * row.t();
            b += w * row *
                 cv::Matx12d(static_cast<double>(samples[k].d.x),
                             static_cast<double>(samples[k].d.y));
        }
        const cv::Matx<double, 3, 2> x = a.solve(b, cv::DECOMP_CHOLESKY);
        for (std::size_t k = 0; k < 3; ++k)
            fit.of[k] = Vec2(static_cast<float>(x(static_cast<int>(k), 0)),
                             static_cast<float>(x(static_cast<int>(k), 1)));
    }
    return fit;
}

// How far the surface moves as one piece, 0 to 1.
float stiffness(const std::vector<Sample>& samples, const Affine& fit, float unit_px) {
    std::size_t close = 0;
    for (const Sample& s : samples)
        close +=
            glm::length(s.d - fit.at(s.p)) < kClose_px * unit_px + kCloseShare * glm::length(s.d)
                ? 1
                : 0;
    return smooth_step(static_cast<float>(close) / static_cast<float>(samples.size()), kBent,
                       kStiff);
}

// 1: moves as the surface does, -1: as what is around it; less where both move nearly alike.
float side_of(Vec2 motion, Vec2 surface, Vec2 around, float unit_px) {
    const float apart = glm::length(surface - around);
    if (apart <= kTogether_px * unit_px) return 0;
    const float nearer = glm::length(motion - around) - glm::length(motion - surface);
    return smooth_step(apart / unit_px, kTogether_px, kApart_px) *
           std::clamp(nearer / apart, -1.0f, 1.0f);
}

}  // namespace

ImageF1 MotionSides::advance(const SidesInput& in) {
    const std::vector<Sample> samples = samples_inside(in);
    Affine stiff;
    float trust = 0;
    if (samples.size() >= kFewest) {
        stiff = fit_affine(samples, in.area, kExact_px * in.unit_px);
        trust = stiffness(samples, stiff, in.unit_px);
    }
    ImageF1 out(in.area.size());
    parallel_rows(in.area.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < in.area.width(); ++x) {
                const int fx = in.area.x0 + x, fy = in.area.y0 + y;
                if (in.flow.valid.row(fy)[fx] == 0) continue;
                const float* d = in.flow.d.pixel(fx, fy);
                const float* o = in.outside_motion.pixel(x, y);
                const Vec2 p(static_cast<float>(fx), static_cast<float>(fy));
                const float before = sample_bilinear(odds_, p.x + d[0], p.y + d[1]);
                const float now =
                    trust > 0 ? side_of({d[0], d[1]}, stiff.at(p), {o[0], o[1]}, in.unit_px) : 0;
                out.row(y)[x] = std::clamp(kMemory * before + trust * now, -kMost, kMost);
            }
        }
    });
    odds_ = ImageF1(odds_.size());
    for (int y = 0; y < out.height(); ++y)
        std::copy(out.row(y), out.row(y) + out.width(), odds_.pixel(in.area.x0, in.area.y0 + y));
    return out;
}

}  // namespace weft

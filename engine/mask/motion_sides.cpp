#include "engine/mask/motion_sides.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/mask/piece_motion.h"
#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr float kEvery_px = 3;   // in both directions
constexpr float kInside_px = 2;  // motion at the boundary is mixed
constexpr std::size_t kFewestSamples = 60;
constexpr float kClose_px = 0.7f, kCloseShare = 0.05f;  // of the motion: moves as the piece does
// The share that does.
constexpr float kBent = 0.8f, kStiff = 0.95f;
constexpr float kTogether_px = 0.8f, kApart_px = 2;  // between both motions
constexpr float kSidesMemory = 0.9f;                 // of the evidence, from frame to frame

// Of what is surely inside, about as many at every size.
std::vector<PlacePair> samples_inside(const SidesInput& in) {
    const int step = std::max(2, static_cast<int>(std::lround(kEvery_px * in.unit_px)));
    std::vector<PlacePair> out;
    for (int y = in.area.y0; y < in.area.y1; y += step) {
        for (int x = in.area.x0; x < in.area.x1; x += step) {
            if (in.flow.valid.row(y)[x] == 0) continue;
            const float* d = in.flow.d.pixel(x, y);
            if (sample_bilinear(in.prev_phi, static_cast<float>(x) + d[0],
                                static_cast<float>(y) + d[1]) >= kInside_px * in.unit_px) {
                out.push_back(pair_at(in.flow, x, y));
            }
        }
    }
    return out;
}

// How far the surface moves as one piece, 0 to 1.
float stiffness(const std::vector<PlacePair>& samples, const glm::dmat3& piece, float unit_px) {
    if (samples.size() < kFewestSamples) return 0;
    const auto close = std::count_if(samples.begin(), samples.end(), [&](const PlacePair& s) {
        return glm::length(s.to - mapped(piece, s.from)) <
               kClose_px * unit_px + kCloseShare * glm::length(s.to - s.from);
    });
    return smooth_step(static_cast<float>(close) / static_cast<float>(samples.size()), kBent,
                       kStiff);
}

}  // namespace

float side_of(Vec2 motion, Vec2 surface, Vec2 around, float unit_px) {
    const float apart = glm::length(surface - around);
    if (apart <= kTogether_px * unit_px) return 0;
    const float nearer = glm::length(motion - around) - glm::length(motion - surface);
    return smooth_step(apart / unit_px, kTogether_px, kApart_px) *
           std::clamp(nearer / apart, -1.0f, 1.0f);
}

ImageF1 MotionSides::advance(const SidesInput& in) {
    const std::vector<PlacePair> samples = samples_inside(in);
    const glm::dmat3 piece = fit_piece(samples);
    const float trust = stiffness(samples, piece, in.unit_px);
    ImageF1 out(in.area.size());
    parallel_rows(in.area.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < in.area.width(); ++x) {
                const int fx = in.area.x0 + x, fy = in.area.y0 + y;
                if (in.flow.valid.row(fy)[fx] == 0) continue;
                const float* d = in.flow.d.pixel(fx, fy);
                const float* o = in.outside_motion.pixel(x, y);
                const float now = trust > 0 ? side_of({d[0], d[1]}, moved_by(piece, Vec2(fx, fy)),
                                                      {o[0], o[1]}, in.unit_px)
                                            : 0;
                const float before =
                    last(static_cast<float>(fx) + d[0], static_cast<float>(fy) + d[1]);
                out.row(y)[x] = std::clamp(kSidesMemory * before + trust * now, -kMost, kMost);
            }
        }
    });
    odds_ = out;
    area_ = in.area;
    return out;
}

void MotionSides::forget(ViewU8x1 where) {
    for (int y = 0; y < odds_.height(); ++y) {
        for (int x = 0; x < odds_.width(); ++x)
            if (where.row(area_.y0 + y)[area_.x0 + x] != 0) odds_.at(x, y) = 0;
    }
}

float MotionSides::last(float x, float y) const {
    x -= static_cast<float>(area_.x0), y -= static_cast<float>(area_.y0);
    const bool known = x >= 0 && y >= 0 && x <= static_cast<float>(odds_.width() - 1) &&
                       y <= static_cast<float>(odds_.height() - 1);
    return known ? sample_bilinear(odds_, x, y) : 0;
}

void add_sides(const ImageF1& sides, const ImageF1& phi, ImageF1& near, ImageF1& wide) {
    constexpr float kWeight = 0.5f, kClearly = -1;
    parallel_rows(sides.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < sides.width(); ++x) {
                const float side = sides.at(x, y);
                near.at(x, y) += kWeight * side;
                if (phi.at(x, y) > 0) wide.at(x, y) += kWeight * std::min(0.0f, side - kClearly);
            }
        }
    });
}

}  // namespace weft

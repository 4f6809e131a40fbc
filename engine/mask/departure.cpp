#include "engine/mask/departure.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/mask/background_motion.h"
#include "engine/mask/motion_support.h"
#include "engine/mask/piece_motion.h"
#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

// Pixels of 854×480: motion is sampled at every third of them, and not near the boundary, where it
// is mixed.
constexpr float kStride_px = 3, kSureInside_px = 3, kOutside_px = 8;
constexpr float kHalo_px = 25;          // as far as motion spreads over an edge
constexpr float kInvalidWeight = 0.3f;  // of motion that does not lead there and back
constexpr float kFinest_px = 0.25f;     // departures below it are noise
constexpr float kShareMemory = 0.5f;    // of the shares, from frame to frame
constexpr float kUnseenShare = 0.005f;
constexpr float kTooFew = 0.1f;  // of the most samples inside: the rest of it is at an edge
// The total variation between inside and outside from which on motion tells them apart.
constexpr float kAlike = 0.45f, kApart = 0.75f;
constexpr float kMostNow = 3;             // log odds from one frame
constexpr float kDepartureMemory = 0.9f;  // of their sum, from frame to frame
constexpr float kForWeight = 0.25f;
// Ages in frames. What has been inside for kSettled counts as the surface's motion.
constexpr float kOldest = 24, kSettled = 10, kYoung = 6;
// A departure of which the surface has a share below kRare speaks against old pixels as well.
constexpr float kRare = 0.01f, kCommon = 0.04f, kAgainstOld = 0.35f;
// The share of its largest area from which on a surface is shown enough for that.
constexpr float kHalfShown = 0.5f, kShown = 0.8f;

// Two bins for each doubling.
float bin_of(float departure_px) {
    return 2 * std::log2(1 + departure_px / kFinest_px);
}

float before(ViewF1 of, const FlowField& flow, int x, int y) {
    const float* d = flow.d.pixel(x, y);
    return sample_bilinear(of, static_cast<float>(x) + d[0], static_cast<float>(y) + d[1]);
}

int stride_of(float px, float unit_px) {
    return std::max(2, static_cast<int>(std::lround(px * unit_px)));
}

glm::dmat3 background_plane(ViewF1 prev_phi, const FlowField& flow, float unit_px) {
    const int stride = stride_of(2 * kStride_px, unit_px);
    std::vector<PlacePair> samples;
    for (int y = stride / 2; y < prev_phi.height(); y += stride) {
        for (int x = stride / 2; x < prev_phi.width(); x += stride) {
            if (flow.valid.row(y)[x] == 0) continue;
            if (before(prev_phi, flow, x, y) > -kOutside_px * unit_px) continue;
            samples.push_back(pair_at(flow, x, y));
        }
    }
    return fit_piece(samples);
}

template <std::size_t N>
float sum_of(const std::array<float, N>& shares) {
    return std::accumulate(shares.begin(), shares.end(), 0.0f);
}

// Blends the shares of this frame into the running ones; those of nothing change nothing.
template <std::size_t N>
void blend_in(std::array<float, N>& running, const std::array<float, N>& counts) {
    const float sum = sum_of(counts);
    if (sum <= 0) return;
    const float keep = sum_of(running) <= 0 ? 0.0f : kShareMemory;
    for (std::size_t i = 0; i < N; ++i)
        running[i] = keep * running[i] + (1 - keep) * counts[i] / sum;
}

template <std::size_t N>
std::array<float, N> smoothed(const std::array<float, N>& in) {
    std::array<float, N> out{};
    for (std::size_t i = 0; i < N; ++i)
        out[i] = 0.25f * in[i > 0 ? i - 1 : 0] + 0.5f * in[i] + 0.25f * in[std::min(i + 1, N - 1)];
    return out;
}

}  // namespace

// A step of the walk, and the background's motion: one plane's, and what is near.
struct Departure::Step {
    ViewF1 prev_phi;
    const FlowField& flow;
    float unit_px;
    glm::dmat3 plane;
    ImageF2 near;

    Step(ViewF1 phi, const FlowField& prev_from_cur, float unit)
        : prev_phi(phi),
          flow(prev_from_cur),
          unit_px(unit),
          plane(background_plane(phi, prev_from_cur, unit)),
          near(background_motion(phi, prev_from_cur, kHalo_px * unit)) {}

    // px of 854×480.
    [[nodiscard]] float departure(int x, int y) const {
        const float* d = flow.d.pixel(x, y);
        const float* n = near.pixel(x, y);
        const Vec2 motion(d[0], d[1]);
        return std::min(glm::length(motion - moved_by(plane, Vec2(x, y))),
                        glm::length(motion - Vec2(n[0], n[1]))) /
               unit_px;
    }
};

// What a frame's motion can tell.
struct Departure::Evidence {
    Shares ratios;  // log odds of each departure, whether or not the two can be told apart
    float trust;    // how far motion tells inside and outside apart, 0 to 1
    float shown;    // whether enough of the surface is seen to trust what it hardly does, 0 to 1
};

Departure::Departure(ViewF1 key_phi) : age_(key_phi.size()), odds_(key_phi.size()) {
    for (int y = 0; y < key_phi.height(); ++y)
        for (int x = 0; x < key_phi.width(); ++x)
            age_.at(x, y) = key_phi.row(y)[x] > 0 ? kOldest : 0.0f;
}

Departure::Evidence Departure::count(const Step& step) {
    Shares inside{}, outside{};
    float shown = 0;
    const int stride = stride_of(kStride_px, step.unit_px);
    for (int y = stride / 2; y < step.prev_phi.height(); y += stride) {
        for (int x = stride / 2; x < step.prev_phi.width(); x += stride) {
            const float phi = before(step.prev_phi, step.flow, x, y) / step.unit_px;
            if (phi < kSureInside_px && phi > -kOutside_px) continue;
            if (phi > 0) ++shown;
            // A leak must not teach how the surface moves.
            if (phi > 0 && before(age_, step.flow, x, y) < kSettled) continue;
            const float bin = std::min(bin_of(step.departure(x, y)), static_cast<float>(kBins - 1));
            (phi > 0 ? inside : outside)[static_cast<std::size_t>(bin)] +=
                step.flow.valid.row(y)[x] != 0 ? 1.0f : kInvalidWeight;
        }
    }
    // What is left of a surface that goes behind something moves as that does.
    const float samples = sum_of(inside);
    most_inside_ = std::max(most_inside_, samples);
    if (samples > kTooFew * most_inside_) blend_in(inside_, inside);
    most_shown_ = std::max(most_shown_, shown);
    blend_in(outside_, outside);
    return {ratios(smoothed(inside_)), trust(),
            smooth_step(shown / std::max(most_shown_, 1.0f), kHalfShown, kShown)};
}

// How far the motion of inside and outside differs, 0 to 1.
float Departure::trust() const {
    const Shares in = smoothed(inside_), out = smoothed(outside_);
    float apart = 0;
    for (std::size_t i = 0; i < kBins; ++i)
        apart += 0.5f * std::abs(in[i] - out[i]);
    return smooth_step(apart, kAlike, kApart);
}

Departure::Shares Departure::ratios(const Shares& in) const {
    const Shares out = smoothed(outside_);
    Shares ratios{};
    for (std::size_t i = 0; i < kBins; ++i) {
        const float ratio = std::log((in[i] + kUnseenShare) / (out[i] + kUnseenShare));
        ratios[i] = std::clamp(ratio, -kMostNow, kMostNow);
    }
    return ratios;
}

// What one frame says of a pixel.
float Departure::odds_now(const DepartureInput& in, Vec2i at, float departure,
                          const Evidence& evidence) const {
    const float bin = std::min(bin_of(departure), static_cast<float>(kBins) - 1.001f);
    const auto i = static_cast<std::size_t>(bin);
    const float part = bin - static_cast<float>(i);
    const auto read = [&](const Shares& of) { return (1 - part) * of[i] + part * of[i + 1]; };
    const float now = read(evidence.ratios);
    if (now > 0) return evidence.trust * kForWeight * now;
    const float young = evidence.trust * std::exp(-age_.at(at.x, at.y) / kYoung);
    // A departure that the surface hardly has needs no other difference between it and the rest.
    float old = evidence.shown * kAgainstOld * (1 - smooth_step(read(inside_), kRare, kCommon));
    if (now == 0 || old <= young || !in.area.contains(at.x, at.y)) return now * young;
    const float* surface = in.surface_motion.pixel(at.x - in.area.x0, at.y - in.area.y0);
    const float* measured = in.flow.d.pixel(at.x, at.y);
    old *= speaks_against({in.frame, in.prev_frame, in.area}, at, Vec2(surface[0], surface[1]),
                          Vec2(measured[0], measured[1]));
    return now * std::max(old, young);
}

const ImageF1& Departure::advance(const DepartureInput& in) {
    const Step step(in.prev_phi, in.flow, in.unit_px);
    const Evidence evidence = count(step);
    Shares any;
    any.fill(1.0f / kBins);
    any = ratios(any);
    const Size size = in.prev_phi.size();
    const ImageF1 age_before = std::exchange(age_, ImageF1(size));
    ImageF1 odds(size);
    departs_ = ImageF1(size);
    parallel_rows(size.height, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < size.width; ++x) {
                // What has just been uncovered came from nowhere: nothing is known of it.
                const bool known = in.flow.valid.row(y)[x] != 0;
                if (known && before(in.prev_phi, in.flow, x, y) > 0)
                    age_.at(x, y) = std::min(before(age_before, in.flow, x, y) + 1, kOldest);
                const float departure = step.departure(x, y);
                const float bin = std::min(bin_of(departure), static_cast<float>(kBins - 1));
                departs_.at(x, y) = evidence.trust * any[static_cast<std::size_t>(bin)];
                const float now = odds_now(in, {x, y}, departure, evidence);
                float sum = known ? kDepartureMemory * before(odds_, in.flow, x, y) : 0.0f;
                // What moves with the background now was taken for surface by an edge's motion.
                if (now < 0) sum = std::min(sum, 0.0f);
                odds.at(x, y) = std::clamp(sum + now, -kMostAgainst, kMostFor);
            }
        }
    });
    odds_ = std::move(odds);
    return odds_;
}

void Departure::correct(ViewU8x1 where, ViewU8x1 inside) {
    for (int y = 0; y < where.height(); ++y) {
        for (int x = 0; x < where.width(); ++x) {
            if (where.row(y)[x] == 0) continue;
            odds_.at(x, y) = 0;
            age_.at(x, y) = inside.row(y)[x] != 0 ? kOldest : 0.0f;
        }
    }
}

void add_odds(const ImageF1& departure, const SurfacePalette& palette, ViewU8x3 part,
              const Recti& area, ImageF1& near, ImageF1& wide) {
    constexpr float kFor = 0.5f, kOwnOdds = 3, kLeastAgainst = 0.25f;
    parallel_rows(area.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < area.width(); ++x) {
                const float odds = departure.at(area.x0 + x, area.y0 + y);
                if (odds >= 0) {
                    near.at(x, y) += kFor * odds;
                    continue;
                }
                const float own = palette.odds(part.pixel(x, y)) / kOwnOdds;
                wide.at(x, y) =
                    std::min(wide.at(x, y), 0.0f) + odds * std::clamp(1 - own, kLeastAgainst, 1.0f);
            }
        }
    });
}

}  // namespace weft

#include "engine/mask/surface_palette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace weft {
namespace {

constexpr int kBits = 4;  // a cell's side is 16 levels; smoothed, the tolerance is about as much
constexpr int kSide = 1 << kBits;
constexpr int kCells = kSide * kSide * kSide;
constexpr float kLeastColorShare = 2e-4f;  // of a colour that was not seen
constexpr float kForeignShare = 6e-4f;     // what was not seen at all is more often something else
constexpr float kMostOdds = 4;
constexpr float kFrameWeight = 0.1f;  // weight of a frame against those before
constexpr float kKeyClearancePx = 2;
constexpr int kRimWeight = 1, kDeepWeight = 8;  // of a painted pixel

int cell_of(const std::uint8_t* c) {
    constexpr int kShift = 8 - kBits;
    return ((c[0] >> kShift) * kSide + (c[1] >> kShift)) * kSide + (c[2] >> kShift);
}

// A binomial blur along each axis of the cube: the estimate does not depend on where cells end.
std::vector<float> blurred_shares(const std::vector<float>& shares) {
    std::vector<float> from = shares, to(shares.size());
    for (const int step : {1, kSide, kSide * kSide}) {
        for (int i = 0; i < kCells; ++i) {
            const int at = i / step % kSide;
            const float low = from[static_cast<std::size_t>(at > 0 ? i - step : i)];
            const float high = from[static_cast<std::size_t>(at + 1 < kSide ? i + step : i)];
            to[static_cast<std::size_t>(i)] =
                0.25f * (low + high) + 0.5f * from[static_cast<std::size_t>(i)];
        }
        std::swap(from, to);
    }
    return from;
}

}  // namespace

SurfacePalette::SurfacePalette(ViewU8x3 frame, ViewF1 phi, float rim_px)
    : inside_(kCells), outside_(kCells), odds_(kCells) {
    count(frame, phi, {kKeyClearancePx, rim_px}, 0);
    tabulate();
}

void SurfacePalette::follow(ViewU8x3 frame, ViewF1 phi, float core_px) {
    count(frame, phi, {core_px, core_px}, 1 - kFrameWeight);
    tabulate();
}

void SurfacePalette::count(ViewU8x3 frame, ViewF1 phi, const Depths& depths, float keep) {
    std::array<std::vector<std::int32_t>, 2> counts{std::vector<std::int32_t>(kCells),
                                                    std::vector<std::int32_t>(kCells)};
    std::array<std::int64_t, 2> total{0, 0};
    for (int y = 0; y < frame.height(); ++y) {
        const float* p = phi.row(y);
        for (int x = 0; x < frame.width(); ++x) {
            if (std::abs(p[x]) < depths.counted_px) continue;
            const std::size_t side = p[x] > 0 ? 0 : 1;
            const int weight = side == 0 && p[x] < depths.sure_px ? kRimWeight : kDeepWeight;
            counts[side][static_cast<std::size_t>(cell_of(frame.pixel(x, y)))] += weight;
            total[side] += weight;
        }
    }
    for (const std::size_t side : {0, 1}) {
        if (total[side] == 0) continue;
        std::vector<float>& shares = side == 0 ? inside_ : outside_;
        const float weight = (1 - keep) / static_cast<float>(total[side]);
        for (std::size_t i = 0; i < shares.size(); ++i)
            shares[i] = keep * shares[i] + weight * static_cast<float>(counts[side][i]);
    }
}

void SurfacePalette::tabulate() {
    const std::vector<float> in = blurred_shares(inside_), out = blurred_shares(outside_);
    for (std::size_t i = 0; i < in.size(); ++i) {
        const float ratio = (in[i] + kLeastColorShare) / (out[i] + kForeignShare);
        odds_[i] = std::clamp(std::log(ratio), -kMostOdds, kMostOdds);
    }
}

float SurfacePalette::own_odds(float share) const {
    constexpr int kSteps = 80;
    std::array<float, kSteps + 1> shares{};
    float total = 0, below = 0;
    for (std::size_t i = 0; i < inside_.size(); ++i) {
        const float step = (odds_[i] + kMostOdds) / (2 * kMostOdds) * kSteps;
        shares[static_cast<std::size_t>(step)] += inside_[i];
        total += inside_[i];
    }
    std::size_t k = 0;
    while (k < kSteps && below + shares[k] < share * total)
        below += shares[k++];
    return kMostOdds * (2 * static_cast<float>(k) / kSteps - 1);
}

float SurfacePalette::odds(const std::uint8_t* color) const {
    return odds_[static_cast<std::size_t>(cell_of(color))];
}

}  // namespace weft

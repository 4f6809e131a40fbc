#include "engine/temporal/shutter.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

// Luma between pixels, bilinear; p inside the frame by a pixel.
float luma_at(ViewU8x1 luma, Vec2 p) {
    const float x = p.x - 0.5f, y = p.y - 0.5f;
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
    const float top = luma.at(i, j) + fx * static_cast<float>(luma.at(i + 1, j) - luma.at(i, j));
    const float low =
        luma.at(i, j + 1) + fx * static_cast<float>(luma.at(i + 1, j + 1) - luma.at(i, j + 1));
    return top + fy * (low - top);
}

bool well_inside(ViewU8x1 visible, Vec2 p) {
    const int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
    return rect_of(visible.size()).grown(-2).contains(x, y) && visible.at(x, y) >= 250;
}

constexpr int kMostLags = 64;           // px
using Variogram = std::vector<double>;  // at 0, 1, 2 … px

// The effect of a box of `length` along the motion on a picture's variogram (Journel & Huijbregts
// 1978): the mean of γ(t + u) − γ(u) under the triangle of u from −length to length.
double regularised(const Variogram& sharp, int t, double length) {
    if (length < 1e-3) return sharp[static_cast<std::size_t>(t)];
    const auto gamma = [&](double x) {
        x = std::min(std::abs(x), static_cast<double>(sharp.size() - 1) - 1e-6);
        const auto k = static_cast<std::size_t>(x);
        return sharp[k] + (x - static_cast<double>(k)) * (sharp[k + 1] - sharp[k]);
    };
    constexpr int kSteps = 24;
    double sum = 0, weights = 0;
    for (int k = -kSteps + 1; k < kSteps; ++k) {
        const double u = length * k / kSteps, w = 1.0 - std::abs(u) / length;
        sum += w * (gamma(t + u) - gamma(u));
        weights += w;
    }
    return sum / weights;
}

// How badly a blur of `length` explains the variogram along the motion by the one across it: mean
// squared difference of the logarithms, with free contrast.
double misfit(const Variogram& along, const Variogram& across, double length, int reach) {
    double sum = 0, squares = 0;
    for (int t = 1; t <= reach; ++t) {
        const double blurred = regularised(across, t, length);
        // Long double: see docs/decisions/0002-determinism.md.
        const long double ratio = along[static_cast<std::size_t>(t)] / std::max(blurred, 1e-9);
        const auto d = static_cast<double>(std::log(ratio));
        sum += d;
        squares += d * d;
    }
    return squares / reach - (sum / reach) * (sum / reach);
}

// The lags (px) over which the variograms are compared, at a speed in px per frame.
int reach_at(double speed) {
    return std::clamp(static_cast<int>(speed), 4, kMostLags / 2);
}

// The share of a frame during which the shutter is open; 0 if a sharp picture explains as much.
double open_share(const Variogram& along, const Variogram& across, double speed) {
    const int reach = reach_at(speed);
    const double sharp = misfit(along, across, 0, reach);
    double best = 0, least = sharp;
    for (double length = 0.5; length <= speed && length < kMostLags / 2; length += 0.25) {
        const double d = misfit(along, across, length, reach);
        if (d < least) {
            least = d;
            best = length;
        }
    }
    // Slanting surfaces and directional patterns reach a third of this without any blur.
    constexpr double kClearly = 0.02, kExplained = 0.25, kShortest = 0.15;
    const bool blurred = sharp > kClearly && least < kExplained * sharp && best > kShortest * speed;
    return blurred ? best / speed : 0.0;
}

}  // namespace

void ShutterMeter::add(ViewU8x1 luma, ViewU8x1 visible, const LatticeField& prev_from_cur) {
    constexpr float kSlowest = 4.0f;  // px a frame
    constexpr int kStride = 2, kFewest = 400;
    struct Place {
        Vec2 p, ahead;
    };
    std::vector<Place> places;
    double speed = 0;
    for (int y = 2; y < visible.height() - 2; y += kStride) {
        for (int x = 2; x < visible.width() - 2; x += kStride) {
            if (visible.at(x, y) < 250) continue;
            const Vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            const Vec2 v = -prev_from_cur.at(p);
            const float here = std::hypot(v.x, v.y);
            if (here < kSlowest) continue;
            speed += here;
            places.push_back({p, v / here});
        }
    }
    if (places.size() < kFewest) return;
    speed /= static_cast<double>(places.size());
    // A blur over the whole displacement also averages that far beyond the compared lags. A small
    // region may not have more.
    const int lags = std::min(kMostLags, 2 * reach_at(speed) + 2);
    Variogram along(static_cast<std::size_t>(lags) + 1), across = along, count = along;
    for (const Place& place : places) {
        const Vec2 aside(-place.ahead.y, place.ahead.x);
        const float here = luma_at(luma, place.p);
        for (int t = 1; t <= lags; ++t) {
            const Vec2 a = place.p + static_cast<float>(t) * place.ahead;
            const Vec2 b = place.p + static_cast<float>(t) * aside;
            if (!well_inside(visible, a) || !well_inside(visible, b)) break;
            const double da = luma_at(luma, a) - here, db = luma_at(luma, b) - here;
            const auto at = static_cast<std::size_t>(t);
            along[at] += da * da;
            across[at] += db * db;
            count[at] += 1;
        }
    }
    if (count.back() < kFewest) return;
    for (std::size_t t = 1; t < count.size(); ++t) {
        along[t] = std::max(along[t] / count[t], 1e-3);
        across[t] = std::max(across[t] / count[t], 1e-3);
    }
    open_.push_back(static_cast<float>(open_share(along, across, speed)));
}

float ShutterMeter::degrees() const {
    if (open_.empty()) return 0;
    std::vector<float> sorted = open_;
    std::sort(sorted.begin(), sorted.end());
    return std::min(360.0f, 360.0f * sorted[(sorted.size() - 1) / 2]);
}

}  // namespace weft

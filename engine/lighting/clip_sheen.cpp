#include "engine/lighting/clip_sheen.h"

#include <algorithm>
#include <cmath>

#include "engine/core/linear_system.h"
#include "engine/core/smooth_step.h"

namespace weft {
namespace {

constexpr int kFitStep = 4;  // pixels between those that are fitted
// Of what a change with direction would be: less is none, more may be one.
constexpr float kUnchanged = 0.1f, kMayChange = 0.25f;
// sin² of the turn: 15° may be errors of motion, 25° are none.
constexpr float kLeastTurn = 0.065f, kTurn = 0.18f;
constexpr double kLieRidge = 1e-3;  // of the weights, in pixels²: a line of pixels tells no turn

// sin² of the turn from one lie to another.
float turn_between(const SurfaceLie& a, const SurfaceLie& b) {
    const float det = a[0] * a[3] - a[1] * a[2];
    if (!(std::abs(det) > 1e-6f)) return 0;
    // b after the inverse of a.
    const float p = (b[0] * a[3] - b[1] * a[2]) / det, q = (b[1] * a[0] - b[0] * a[1]) / det;
    const float r = (b[2] * a[3] - b[3] * a[2]) / det, s = (b[3] * a[0] - b[2] * a[1]) / det;
    // The singular values of a 2 × 2 matrix are half the sum and half the difference of these.
    const float whole = std::sqrt((p + s) * (p + s) + (r - q) * (r - q));
    const float bent = std::sqrt((p - s) * (p - s) + (r + q) * (r + q));
    if (!(whole > 0)) return 0;
    const float roll = p + s > 0 ? (r - q) * (r - q) / (whole * whole) : 1.0f;
    const float squeeze = std::max(0.0f, (whole - bent) / (whole + bent));
    return std::max(roll, 1 - squeeze * squeeze);
}

}  // namespace

SurfaceLie surface_lie(const SurfaceSample& s, const ImageF2& ref_from_cur) {
    LinearSystem<3> for_x{}, for_y{};
    for (int y = 0; y < s.box.height(); y += kFitStep) {
        for (int x = 0; x < s.box.width(); x += kFitStep) {
            const float* d = ref_from_cur.pixel(x, y);
            const double w = s.weight.row(y)[x];
            if (!(w > 0) || !std::isfinite(d[0] + d[1])) continue;
            const std::array<double, 3> terms{static_cast<double>(x), static_cast<double>(y), 1};
            for (std::size_t i = 0; i < 3; ++i) {
                for (std::size_t j = 0; j < 3; ++j) {
                    for_x[i][j] += w * terms[i] * terms[j];
                    for_y[i][j] += w * terms[i] * terms[j];
                }
                for_x[i][3] += w * terms[i] * d[0];
                for_y[i][3] += w * terms[i] * d[1];
            }
        }
    }
    if (!(for_x[2][2] > 0)) return {1, 0, 0, 1};
    for (std::size_t i = 0; i < 2; ++i)
        for_x[i][i] += kLieRidge * for_x[2][2], for_y[i][i] += kLieRidge * for_x[2][2];
    const auto u = solve(for_x), v = solve(for_y);
    return {static_cast<float>(1 + u[0]), static_cast<float>(u[1]), static_cast<float>(v[0]),
            static_cast<float>(1 + v[1])};
}

float most_turned(const std::vector<SurfaceLie>& lies) {
    float most = 0;
    for (std::size_t i = 0; i < lies.size(); ++i)
        for (std::size_t j = i + 1; j < lies.size(); ++j)
            most = std::max(most, turn_between(lies[i], lies[j]));
    return most;
}

void ColourChange::add(const ImageF1& usual, const ImageF1& now, const ImageF1& known) {
    double n = 0, a = 0, b = 0, aa = 0, ab = 0, bb = 0;
    for (std::size_t i = 0; i < known.size_bytes() / sizeof(float); ++i) {
        if (!(known.data()[i] > 0)) continue;
        const double u = usual.data()[i], v = now.data()[i];
        n += 1, a += u, b += v, aa += u * u, ab += u * v, bb += v * v;
    }
    if (n < 2) return;
    const double usual2 = aa - a * a / n, both = ab - a * b / n, now2 = bb - b * b / n;
    if (!(usual2 > 0)) return;
    all_ += now2;
    change_ += std::max(0.0, now2 - both * both / usual2);
}

float painted_on(float turn, float changed_share) {
    return smooth_step(turn, kLeastTurn, kTurn) *
           (1.0f - smooth_step(changed_share / std::max(turn, 1e-6f), kUnchanged, kMayChange));
}

}  // namespace weft

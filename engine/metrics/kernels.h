#pragma once
// Interpolation kernels for sub-pixel lookups.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace weft {

/// How a value between pixel centres is read. Catmull-Rom is the cubic of Keys 1981 with a = −1/2;
/// Lanczos4 has eight taps an axis, divided by their sum.
enum class Kernel { kBilinear, kCatmullRom, kLanczos4 };

constexpr int kernel_taps(Kernel k) {
    return k == Kernel::kBilinear ? 2 : k == Kernel::kCatmullRom ? 4 : 8;
}

/// Weights of the taps for a position `f` ∈ [0, 1) past the tap with index taps/2 − 1.
inline void kernel_weights(Kernel k, float f, float* w) {
    if (k == Kernel::kBilinear) {
        w[0] = 1.0f - f;
        w[1] = f;
    } else if (k == Kernel::kCatmullRom) {
        const float f2 = f * f;
        const float f3 = f2 * f;
        w[0] = 0.5f * (-f3 + 2.0f * f2 - f);
        w[1] = 0.5f * (3.0f * f3 - 5.0f * f2 + 2.0f);
        w[2] = 0.5f * (-3.0f * f3 + 4.0f * f2 + f);
        w[3] = 0.5f * (f3 - f2);
    } else {
        constexpr double kPi = std::numbers::pi;
        std::array<double, 8> v{};
        double sum = 0;
        for (int i = 0; i < 8; ++i) {
            const double x = static_cast<double>(f) + 3.0 - i;
            const double a = kPi * x;
            v[static_cast<std::size_t>(i)] =
                std::abs(x) < 1e-9 ? 1.0 : 4.0 * std::sin(a) * std::sin(a / 4.0) / (a * a);
            sum += v[static_cast<std::size_t>(i)];
        }
        for (int i = 0; i < 8; ++i)
            w[i] = static_cast<float>(v[static_cast<std::size_t>(i)] / sum);
    }
}

}  // namespace weft

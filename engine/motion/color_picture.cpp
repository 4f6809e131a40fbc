#include "engine/motion/color_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/parallel.h"

namespace weft {
namespace {

// Natural logarithms of the linear light of sRGB codes (IEC 61966-2-1), and a little more, since in
// the dark ratios are noise.
const std::array<float, 256>& log_light() {
    static const std::array<float, 256> table = [] {
        constexpr long double kDark = 0.02L;
        std::array<float, 256> out{};
        for (std::size_t k = 0; k < out.size(); ++k) {
            // Long double: see docs/decisions/0002-determinism.md.
            const long double v = static_cast<long double>(k) / 255;
            const long double linear =
                v <= 0.04045L ? v / 12.92L : std::pow((v + 0.055L) / 1.055L, 2.4L);
            out[k] = static_cast<float>(std::log(linear + kDark));
        }
        return out;
    }();
    return table;
}

// The logarithms of the ratios to their mean.
Vec3 ratios(const std::uint8_t* rgb) {
    const auto& light = log_light();
    const Vec3 v(light[rgb[0]], light[rgb[1]], light[rgb[2]]);
    return v - (v.x + v.y + v.z) / 3;
}

using ColorMoments = std::array<double, 9>;  // Σ x, y, z, xx, xy, xz, yy, yz, zz

// The direction of greatest variance, by power iteration; and that variance.
std::pair<Vec3, double> principal(const ColorMoments& m, double n) {
    const glm::dvec3 mean = glm::dvec3(m[0], m[1], m[2]) / n;
    const glm::dmat3 c(
        m[3] / n - mean.x * mean.x, m[4] / n - mean.x * mean.y, m[5] / n - mean.x * mean.z,
        m[4] / n - mean.x * mean.y, m[6] / n - mean.y * mean.y, m[7] / n - mean.y * mean.z,
        m[5] / n - mean.x * mean.z, m[7] / n - mean.y * mean.z, m[8] / n - mean.z * mean.z);
    constexpr int kIterations = 60;
    glm::dvec3 v(0.8, -0.55, -0.25);  // no axis of symmetry
    for (int k = 0; k < kIterations; ++k) {
        const glm::dvec3 next = c * v;
        const double length = glm::length(next);
        if (!(length > 0)) return {Vec3(v), 0};
        v = next / length;
    }
    return {Vec3(v), glm::dot(v, c * v)};
}

}  // namespace

std::optional<ColorAxis> color_axis(ViewU8x3 display, ViewU8x1 visible) {
    // Means of blocks, in which grain counts little.
    constexpr int kBlock = 4;
    constexpr double kFewest = 40, kHardlyAny = 0.05;
    ColorMoments sum{};
    double count = 0;
    for (int y = 0; y + kBlock <= display.height(); y += kBlock) {
        for (int x = 0; x + kBlock <= display.width(); x += kBlock) {
            Vec3 mean(0);
            bool inside = true;
            for (int j = 0; j < kBlock; ++j) {
                for (int i = 0; i < kBlock; ++i) {
                    inside = inside && visible.at(x + i, y + j) >= 128;
                    mean += ratios(display.pixel(x + i, y + j));
                }
            }
            if (!inside) continue;
            const glm::dvec3 v = glm::dvec3(mean) / double{kBlock * kBlock};
            const ColorMoments own{v.x,       v.y,       v.z,       v.x * v.x, v.x * v.y,
                                   v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
            for (std::size_t k = 0; k < own.size(); ++k)
                sum[k] += own[k];
            ++count;
        }
    }
    if (count < kFewest) return std::nullopt;
    const auto [direction, variance] = principal(sum, count);
    if (variance < kHardlyAny * kHardlyAny) return std::nullopt;
    const glm::dvec3 mean = glm::dvec3(sum[0], sum[1], sum[2]) / count;
    return ColorAxis{direction, glm::dot(direction, Vec3(mean))};
}

Matte color_picture(ViewU8x3 display, const ColorAxis& axis) {
    constexpr float kMiddle = 128, kLevels = 110;  // of a change by a factor of e
    Matte out(display.size());
    parallel_rows(display.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const std::uint8_t* from = display.row(y);
            std::uint8_t* to = out.row(y);
            for (int x = 0; x < display.width(); ++x, from += 3) {
                const float along = glm::dot(axis.direction, ratios(from)) - axis.middle;
                to[x] = static_cast<std::uint8_t>(
                    std::clamp(kMiddle + kLevels * along + 0.5f, 0.0f, 255.0f));
            }
        }
    });
    return out;
}

}  // namespace weft

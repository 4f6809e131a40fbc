#include "texture_db/starter/toolkit.h"

#include <algorithm>

namespace weft::starter {

Rgb shifted(Rgb c, float turns, float saturation, float brightness) {
    // A turn about the grey axis (Rodrigues), then towards or away from grey.
    const float grey = (c.r + c.g + c.b) / 3;
    const float angle = turns * 6.2831853f, cosine = std::cos(angle), sine = std::sin(angle);
    const Rgb d{c.r - grey, c.g - grey, c.b - grey};
    constexpr float k = 0.57735027f;
    const Rgb turned{d.r * cosine + (d.b - d.g) * k * sine, d.g * cosine + (d.r - d.b) * k * sine,
                     d.b * cosine + (d.g - d.r) * k * sine};
    const Rgb out{(grey + turned.r * saturation) * brightness,
                  (grey + turned.g * saturation) * brightness,
                  (grey + turned.b * saturation) * brightness};
    return {clamp01(out.r), clamp01(out.g), clamp01(out.b)};
}

namespace {

float corner(std::uint32_t seed, int ix, int iy, float dx, float dy) {
    static constexpr std::array<std::array<float, 2>, 8> kGradients{{{1, 0},
                                                                     {0.7071f, 0.7071f},
                                                                     {0, 1},
                                                                     {-0.7071f, 0.7071f},
                                                                     {-1, 0},
                                                                     {-0.7071f, -0.7071f},
                                                                     {0, -1},
                                                                     {0.7071f, -0.7071f}}};
    const auto& g = kGradients[hash(seed, ix, iy) & 7u];
    return g[0] * dx + g[1] * dy;
}

}  // namespace

float noise(float x, float y, std::uint32_t seed) {
    const int ix = floor_int(x), iy = floor_int(y);
    const float fx = x - static_cast<float>(ix), fy = y - static_cast<float>(iy);
    const float u = fx * fx * fx * (fx * (fx * 6 - 15) + 10);
    const float v = fy * fy * fy * (fy * (fy * 6 - 15) + 10);
    const float a = corner(seed, ix, iy, fx, fy), b = corner(seed, ix + 1, iy, fx - 1, fy);
    const float c = corner(seed, ix, iy + 1, fx, fy - 1);
    const float d = corner(seed, ix + 1, iy + 1, fx - 1, fy - 1);
    const float top = a + (b - a) * u, low = c + (d - c) * u;
    return 1.5f * (top + (low - top) * v);
}

float fbm(float x, float y, int octaves, std::uint32_t seed, float gain) {
    float sum = 0, weight = 1, total = 0;
    for (int i = 0; i < octaves; ++i) {
        sum += weight * noise(x, y, seed + static_cast<std::uint32_t>(i) * 101u);
        total += weight;
        weight *= gain;
        // Turned a little, so that the lattices do not line up.
        const float nx = 1.92f * x + 0.56f * y + 17.3f;
        y = 1.92f * y - 0.56f * x + 9.1f;
        x = nx;
    }
    return sum / total * 1.3f;
}

float ridged(float x, float y, int octaves, std::uint32_t seed) {
    float sum = 0, weight = 1, total = 0;
    for (int i = 0; i < octaves; ++i) {
        const float n =
            1 - std::min(1.0f,
                         1.6f * std::abs(noise(x, y, seed + static_cast<std::uint32_t>(i) * 77u)));
        sum += weight * n * n;
        total += weight;
        weight *= 0.5f;
        const float nx = 1.92f * x + 0.56f * y + 5.7f;
        y = 1.92f * y - 0.56f * x + 3.3f;
        x = nx;
    }
    return sum / total;
}

Cells cells(float x, float y, float jitter, std::uint32_t seed) {
    const int ix = floor_int(x), iy = floor_int(y);
    Cells out;
    out.first = out.second = 1e9f;
    float second_x = 0, second_y = 0;
    for (int j = iy - 1; j <= iy + 1; ++j) {
        for (int i = ix - 1; i <= ix + 1; ++i) {
            const float px = static_cast<float>(i) + 0.5f + jitter * (hash01(seed, i, j, 1) - 0.5f);
            const float py = static_cast<float>(j) + 0.5f + jitter * (hash01(seed, i, j, 2) - 0.5f);
            const float dx = x - px, dy = y - py, d = dx * dx + dy * dy;
            if (d < out.first) {
                out.second = out.first;
                second_x = out.dx;
                second_y = out.dy;
                out.first = d;
                out.dx = dx;
                out.dy = dy;
                out.ix = i;
                out.iy = j;
            } else if (d < out.second) {
                out.second = d;
                second_x = dx;
                second_y = dy;
            }
        }
    }
    const float ax = second_x - out.dx, ay = second_y - out.dy;
    const float between = std::sqrt(ax * ax + ay * ay);
    out.edge = between > 1e-6f ? (out.second - out.first) / (2 * between) : 0.0f;
    out.first = std::sqrt(out.first);
    out.second = std::sqrt(out.second);
    out.id = hash(seed, out.ix, out.iy, 3);
    return out;
}

}  // namespace weft::starter

#pragma once
// Internal: building blocks of the procedural families: dice, noise, cells, colours.

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "engine/core/rng.h"

namespace weft::starter {

/// sRGB-encoded colour, 0 … 1.
struct Rgb {
    float r = 0, g = 0, b = 0;
};
constexpr Rgb operator+(Rgb a, Rgb b) {
    return {a.r + b.r, a.g + b.g, a.b + b.b};
}
constexpr Rgb operator*(Rgb a, float k) {
    return {a.r * k, a.g * k, a.b * k};
}
constexpr Rgb mix(Rgb a, Rgb b, float t) {
    return a * (1 - t) + b * t;
}
/// 0xRRGGBB.
constexpr Rgb rgb(std::uint32_t hex) {
    return {static_cast<float>(hex >> 16 & 255u) / 255.0f,
            static_cast<float>(hex >> 8 & 255u) / 255.0f, static_cast<float>(hex & 255u) / 255.0f};
}
/// Turns the hue by `turns`, scales the saturation and the brightness.
[[nodiscard]] Rgb shifted(Rgb c, float turns, float saturation, float brightness);

/// The random choices of one texture, in order.
class Dice {
  public:
    Dice(std::uint64_t family, std::uint64_t number) : rng_(0x57454654, family, number) {}
    float uniform(float low, float high) {
        return low + (high - low) * static_cast<float>(rng_.uniform());
    }
    int whole(int low, int high) {  ///< Both ends included.
        return low + static_cast<int>(rng_.below(static_cast<std::uint64_t>(high - low + 1)));
    }
    bool chance(float p) { return uniform(0, 1) < p; }
    std::uint32_t seed() { return static_cast<std::uint32_t>(rng_.next()); }
    template <class T, std::size_t N>
    T pick(const T (&choices)[N]) {
        return choices[static_cast<std::size_t>(whole(0, static_cast<int>(N) - 1))];
    }
    /// One of the colours, varied a little.
    template <std::size_t N>
    Rgb color(const std::uint32_t (&choices)[N], float variety = 1) {
        return shifted(rgb(pick(choices)), uniform(-0.018f, 0.018f) * variety,
                       1 + uniform(-0.18f, 0.18f) * variety, 1 + uniform(-0.12f, 0.12f) * variety);
    }

  private:
    Rng rng_;
};

[[nodiscard]] inline std::uint32_t hash(std::uint32_t seed, int x, int y, std::uint32_t k = 0) {
    std::uint32_t h = seed ^ (static_cast<std::uint32_t>(x) * 0x8da6b343u) ^
                      (static_cast<std::uint32_t>(y) * 0xd8163841u) ^ (k * 0xcb1ab31fu);
    h ^= h >> 16;
    h *= 0x7feb352du;
    h ^= h >> 15;
    h *= 0x846ca68bu;
    return h ^ (h >> 16);
}
[[nodiscard]] inline float hash01(std::uint32_t seed, int x, int y, std::uint32_t k = 0) {
    return static_cast<float>(hash(seed, x, y, k) >> 8) * 0x1p-24f;
}
[[nodiscard]] inline float smooth(float low, float high, float v) {
    float t = (v - low) / (high - low);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return t * t * (3 - 2 * t);
}
[[nodiscard]] inline float clamp01(float v) {
    return v < 0 ? 0 : v > 1 ? 1 : v;
}
[[nodiscard]] inline int floor_int(float v) {
    const int i = static_cast<int>(v);
    return v < static_cast<float>(i) ? i - 1 : i;
}
[[nodiscard]] inline float fraction(float v) {
    return v - static_cast<float>(floor_int(v));
}

/// Gradient noise (Perlin 2002) of unit cells, about −1 … 1.
[[nodiscard]] float noise(float x, float y, std::uint32_t seed);
/// Octaves of it, each of half the size and `gain` of the height; about −1 … 1.
[[nodiscard]] float fbm(float x, float y, int octaves, std::uint32_t seed, float gain = 0.5f);
/// Sharp crests: 0 … 1, 1 on the crest lines.
[[nodiscard]] float ridged(float x, float y, int octaves, std::uint32_t seed);

/// Cellular noise of unit cells (Worley 1996).
struct Cells {
    float first = 0, second = 0;  ///< Distances to the nearest two points.
    float edge = 0;               ///< Distance to the border between them.
    float dx = 0, dy = 0;         ///< From the nearest point.
    int ix = 0, iy = 0;           ///< Which cell.
    std::uint32_t id = 0;
};
[[nodiscard]] Cells cells(float x, float y, float jitter, std::uint32_t seed);

/// A position on a plane of 1 × 1 units (bricks, shingles).
struct Piece {
    int column = 0, row = 0;
    float u = 0, v = 0;  ///< 0 … 1 inside.
};

}  // namespace weft::starter

#pragma once
// A wall of bricks under a light that is known: what the tests of the estimate look at.

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/image.h"
#include "engine/lighting/masked_filters.h"

namespace weft::scene {

constexpr Size kSize{320, 240};

/// Bricks of 24 × 8 px with 2 px of bright mortar, each brick of its own lightness, and some noise.
inline float brick(int x, int y) {
    const int row = y / 10, shifted = x + (row % 2) * 13, column = shifted / 26;
    if (y % 10 >= 8 || shifted % 26 >= 24) return 0.55f;
    const unsigned key = static_cast<unsigned>(row * 131 + column * 71) * 2654435761u;
    return 0.15f + 0.12f * static_cast<float>(key >> 16 & 255u) / 255.0f;
}

/// Light that falls off to the right, and a shadow over x in [shadow_x, shadow_x + 90).
inline float light(int x, int, int shadow_x = 120) {
    const float fall = 1.3f - 0.5f * static_cast<float>(x) / 320.0f;
    return x >= shadow_x && x < shadow_x + 90 ? 0.4f * fall : fall;
}

inline ImageF3 plate(float exposure = 1, int shadow_x = 120) {
    ImageF3 p(kSize);
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
            const float v = exposure * brick(x, y) * light(x, y, shadow_x);
            p.at(x, y, 0) = v, p.at(x, y, 1) = 0.8f * v, p.at(x, y, 2) = 0.7f * v;
        }
    }
    return p;
}

using Colour = std::array<float, 3>;

/// Each pixel's colour by `paint(x, y)`, linear light.
template <class Paint>
ImageF3 cloth(const Paint& paint) {
    ImageF3 out(kSize);
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const Colour colour = paint(x, y);
            std::copy(colour.begin(), colour.end(), out.pixel(x, y));
        }
    }
    return out;
}

inline Colour scaled(Colour colour, float by) {
    for (float& c : colour)
        c *= by;
    return colour;
}

inline Matte box_matte(const Recti& box, Size size = kSize) {
    Matte m(size);
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x)
            m.at(x, y) = 255;
    }
    return m;
}

/// What a plain blur of the log luminance would take for shading, σ in pixels.
inline ImageF1 gaussian_estimate(const ImageF3& linear, const Matte& matte, float sigma) {
    ImageF1 value(linear.size()), weight(linear.size());
    for (int y = 0; y < linear.height(); ++y) {
        for (int x = 0; x < linear.width(); ++x) {
            if (!matte.at(x, y)) continue;
            weight.at(x, y) = 1;
            const float* p = linear.pixel(x, y);
            value.at(x, y) = std::log(0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2] + 1e-3f);
        }
    }
    gaussian_blur(value, sigma);
    gaussian_blur(weight, sigma);
    for (int y = 0; y < linear.height(); ++y) {
        for (int x = 0; x < linear.width(); ++x)
            value.at(x, y) = std::exp(value.at(x, y) / std::max(1e-4f, weight.at(x, y)));
    }
    return value;
}

/// Mean square of ln(shading) after a high pass of `sigma`, well inside the matte.
inline double detail_energy(const ImageF1& shading, const Matte& matte, float sigma) {
    ImageF1 logarithm(shading.size()), mean(shading.size()), weight(shading.size());
    for (int y = 0; y < shading.height(); ++y) {
        for (int x = 0; x < shading.width(); ++x) {
            if (!matte.at(x, y)) continue;
            weight.at(x, y) = 1;
            logarithm.at(x, y) = mean.at(x, y) = std::log(shading.at(x, y));
        }
    }
    gaussian_blur(mean, sigma);
    gaussian_blur(weight, sigma);
    double sum = 0, n = 0;
    for (int y = 0; y < shading.height(); ++y) {
        for (int x = 0; x < shading.width(); ++x) {
            if (!matte.at(x, y) || weight.at(x, y) < 0.95f) continue;
            const double d = logarithm.at(x, y) - mean.at(x, y) / weight.at(x, y);
            sum += d * d, n += 1;
        }
    }
    return n > 0 ? sum / n : 0;
}

}  // namespace weft::scene

#include "engine/lighting/painted_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr int kDownscale = 2;
constexpr float kLeastGain = 0.01f, kMostGain = 100.0f;

float clamped_gain(float gain) {
    return std::clamp(gain, kLeastGain, kMostGain);
}

// The numbers of a lamp with its places unsqueezed.
std::vector<float> unsqueezed(LampKind kind, std::vector<float> numbers, PixelAspect aspect) {
    if (kind != LampKind::kDirectional) numbers[0] *= aspect.ratio();
    if (kind == LampKind::kGradient) numbers[2] *= aspect.ratio();
    return numbers;
}

// The gain of a lamp at a place, all unsqueezed.
float gain_at(LampKind kind, const std::vector<float>& n, Vec2 at, Vec2 full) {
    const float x = at.x, y = at.y;
    switch (kind) {
        case LampKind::kPoint: {
            const float dx = x - n[0], dy = y - n[1];
            const float r2 = (dx * dx + dy * dy) / std::max(1e-6f, n[2] * n[2]);
            const float fall = std::max(0.0f, 1.0f - r2);
            return 1.0f + (clamped_gain(n[3]) - 1.0f) * fall * fall;
        }
        case LampKind::kDirectional: {
            const float angle = n[0] * std::numbers::pi_v<float> / 180.0f;
            const float half_w = 0.5f * full.x, half_h = 0.5f * full.y;
            // Long double: see docs/decisions/0002-determinism.md. y points down.
            const auto c = static_cast<float>(std::cos(static_cast<long double>(angle))),
                       s = static_cast<float>(-std::sin(static_cast<long double>(angle)));
            const float reach = std::abs(c) * half_w + std::abs(s) * half_h;
            const float t = ((x - half_w) * c + (y - half_h) * s) / std::max(1e-6f, reach);
            return std::exp(t * std::log(clamped_gain(n[1])));
        }
        case LampKind::kGradient: {
            const float dx = n[2] - n[0], dy = n[3] - n[1];
            const float t =
                std::clamp(((x - n[0]) * dx + (y - n[1]) * dy) / std::max(1e-6f, dx * dx + dy * dy),
                           0.0f, 1.0f);
            return clamped_gain(n[4]) + t * (clamped_gain(n[5]) - clamped_gain(n[4]));
        }
    }
    return 1.0f;
}

}  // namespace

Shading painted_shading(const std::vector<Lamp>& lamps, int frame, Size full, PixelAspect aspect) {
    Shading shading{ImageF1(reduced_size(full, kDownscale), 1.0f), kDownscale, full};
    const Vec2 picture =
        aspect.unsqueezed(Vec2(static_cast<float>(full.width), static_cast<float>(full.height)));
    for (const Lamp& lamp : lamps) {
        const std::vector<float> numbers =
            unsqueezed(lamp.kind, lamp.numbers.float_at(frame), aspect);
        parallel_rows(shading.value.height(), 16, [&](int y0, int y1) {
            for (int y = y0; y < y1; ++y) {
                for (int x = 0; x < shading.value.width(); ++x) {
                    const Vec2 at((static_cast<float>(x) + 0.5f) * kDownscale,
                                  (static_cast<float>(y) + 0.5f) * kDownscale);
                    shading.value.row(y)[x] *=
                        gain_at(lamp.kind, numbers, aspect.unsqueezed(at), picture);
                }
            }
        });
    }
    return shading;
}

}  // namespace weft

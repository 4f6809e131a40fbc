#pragma once
// One shot in several sizes: what a surface is, how it moves and what that costs for each pixel
// must not depend on the size in which its plate is delivered.

#include <algorithm>
#include <map>
#include <memory>
#include <tuple>

#include "tests/pipeline/memory_shot.h"

namespace weft::scene {

constexpr Size kSmallest{640, 360};
constexpr Size kSizes[] = {{960, 540}, {1280, 720}, {1920, 1080}, {2560, 1440}};
constexpr Recti kSurface{120, 70, 520, 300};
constexpr int kFrames = 3;
constexpr Vec2 kStep_px{2.4f, -1.1f};

// A faint wall under grain: seen pixel by pixel, nearly a flat fill. Drawn once for all sizes.
inline const Matte& wall_frame(int t, float contrast, float grain_levels) {
    static const WaveTexture texture(17);
    static std::map<std::tuple<int, float, float>, Matte> drawn;
    Matte& frame = drawn[{t, contrast, grain_levels}];
    if (frame.width() > 0) return frame;
    Rng rng(70 + static_cast<std::uint64_t>(t));
    frame = draw(kSmallest, [&](Vec2 p) {
        const float value = texture(p - static_cast<float>(t) * kStep_px) - 0.5f;
        const auto grain = static_cast<float>(rng.uniform() + rng.uniform() - 1);
        return 0.5f + contrast * value + grain_levels / 255 * grain;
    });
    return frame;
}

// The same picture in another size, bilinear: soft, as large plates are.
inline std::shared_ptr<const ImageF3> enlarged(const Matte& small, Size to) {
    auto out = std::make_shared<ImageF3>(to);
    const auto place = [](int at, int from, int count, int& cell, float& f) {
        const float g =
            (static_cast<float>(at) + 0.5f) * static_cast<float>(from) / static_cast<float>(count) -
            0.5f;
        const float inside = std::clamp(g, 0.0f, static_cast<float>(from - 1));
        cell = std::min(static_cast<int>(inside), from - 2);
        f = inside - static_cast<float>(cell);
    };
    for (int y = 0; y < to.height; ++y) {
        int iy = 0, ix = 0;
        float fy = 0, fx = 0;
        place(y, small.height(), to.height, iy, fy);
        for (int x = 0; x < to.width; ++x) {
            place(x, small.width(), to.width, ix, fx);
            const auto at = [&](int dx, int dy) {
                return static_cast<float>(small.at(ix + dx, iy + dy)) / 255;
            };
            const float top = at(0, 0) + fx * (at(1, 0) - at(0, 0));
            const float low = at(0, 1) + fx * (at(1, 1) - at(0, 1));
            std::fill_n(out->pixel(x, y), 3, top + fy * (low - top));
        }
    }
    return out;
}

inline MemoryShot shot_of(Size size, float contrast, float grain_levels) {
    MemoryShot shot(size);
    const auto scaled = [](int v, int to, int from) { return v * to / from; };
    for (int t = 0; t < kFrames; ++t) {
        shot.plates[t] = enlarged(wall_frame(t, contrast, grain_levels), size);
        Matte matte(size);
        for (int y = scaled(kSurface.y0, size.height, kSmallest.height);
             y < scaled(kSurface.y1, size.height, kSmallest.height); ++y) {
            std::fill(matte.row(y) + scaled(kSurface.x0, size.width, kSmallest.width),
                      matte.row(y) + scaled(kSurface.x1, size.width, kSmallest.width), 255);
        }
        shot.mattes[{0, t}] = std::move(matte);
    }
    return shot;
}

inline ShotPlan plan_of(FlowQuality quality) {
    RegionPlan region = make_region(flat_texture({0.5f, 0.5f, 0.5f}));
    region.reference_frames = {0};
    ShotPlan plan = make_plan(std::move(region), 0, kFrames - 1);
    plan.quality = quality;
    return plan;
}

}  // namespace weft::scene

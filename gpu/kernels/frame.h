#pragma once
// A layer of a frame in one go: texture, shading gain (apply_light, the form kGain), composite
// (composite_over); and the roll-off of the finished frame (roll_off). The operations are those of
// engine/lighting and engine/composite, in the same order.

#include "gpu/kernels/sampling.h"

namespace weft::kernels {

/// A pixel where the matte is between 1 and 254.
struct SoftPixel {
    int index;  ///< In the layer's box.
    float old_surface[3];
};

struct LayerArgs {
    SampleArgs texture;  ///< `out` is not used.
    float* frame;
    u8* touched;  ///< The highest matte so far, of the frame's size.
    int frame_w, origin_x, origin_y;
    float multiply[3];     ///< On the texture, before the light.
    const float* shading;  ///< Null: no light.
    int shading_w, shading_h;
    float shading_scale, inverse_reference, strength, least_gain, most_gain;
    const SoftPixel* soft;
    int soft_count;
};

WEFT_HD bool finite(float v) {
    return v - v == 0;
}

/// The shading at plate pixel (x, y), bilinear between the small picture's pixel centres.
WEFT_HD float shading_at(const LayerArgs& a, int x, int y) {
    const float fx = held((static_cast<float>(x) + 0.5f) * a.shading_scale - 0.5f, 0.0f,
                          static_cast<float>(a.shading_w - 1));
    const float fy = held((static_cast<float>(y) + 0.5f) * a.shading_scale - 0.5f, 0.0f,
                          static_cast<float>(a.shading_h - 1));
    const int i = static_cast<int>(fx), j = static_cast<int>(fy);
    const int i1 = smaller(i + 1, a.shading_w - 1), j1 = smaller(j + 1, a.shading_h - 1);
    const float* above = a.shading + static_cast<u64>(j) * static_cast<u64>(a.shading_w);
    const float* below = a.shading + static_cast<u64>(j1) * static_cast<u64>(a.shading_w);
    const float share = fy - static_cast<float>(j);
    const float left = above[i] + share * (below[i] - above[i]);
    const float right = above[i1] + share * (below[i1] - above[i1]);
    return left + (fx - static_cast<float>(i)) * (right - left);
}

/// The lit texture at pixel (x, y) of the layer's box.
WEFT_HD void lit_texture(const LayerArgs& a, int x, int y, float* rgb) {
    PixelSampler(a.texture).sample(x, y, rgb);
    for (int c = 0; c < 3; ++c)
        rgb[c] *= a.multiply[c];
    if (!a.shading) return;
    const float light = shading_at(a, a.origin_x + x, a.origin_y + y);
    if (!(finite(light) && light > 0)) return;
    const float gain =
        held(1.0f + a.strength * (light * a.inverse_reference - 1.0f), a.least_gain, a.most_gain);
    for (int c = 0; c < 3; ++c)
        rgb[c] *= gain;
}

WEFT_HD u64 frame_index(const LayerArgs& a, int i) {
    const int x = i % a.texture.width, y = i / a.texture.width;
    return static_cast<u64>(a.origin_y + y) * static_cast<u64>(a.frame_w) +
           static_cast<u64>(a.origin_x + x);
}

/// Pixels that the layer covers whole, and the union of the mattes.
struct LayerInside {
    using Args = LayerArgs;
    static constexpr int kThreads = 128;
    struct Shared {};

    static int blocks(const Args& a) {
        return ceil_div(a.texture.width * a.texture.height, kThreads);
    }

    template <class Block>
    WEFT_HD static void run(Block& block, Shared&, const Args& a) {
        block.each([&](int t) {
            const int i = block.index() * kThreads + t;
            if (i >= a.texture.width * a.texture.height) return;
            const u8 matte = a.texture.matte[i];
            if (matte == 0) return;
            const u64 at = frame_index(a, i);
            a.touched[at] = larger(a.touched[at], matte);
            if (matte != 255) return;
            lit_texture(a, i % a.texture.width, i / a.texture.width, a.frame + 3 * at);
        });
    }
};

/// Pixels that it covers in part: O = F + M (T − B).
struct LayerEdge {
    using Args = LayerArgs;
    static constexpr int kThreads = 128;
    struct Shared {};

    static int blocks(const Args& a) { return ceil_div(a.soft_count, kThreads); }

    template <class Block>
    WEFT_HD static void run(Block& block, Shared&, const Args& a) {
        block.each([&](int t) {
            const int k = block.index() * kThreads + t;
            if (k >= a.soft_count) return;
            const SoftPixel soft = a.soft[k];
            float rgb[3];
            lit_texture(a, soft.index % a.texture.width, soft.index / a.texture.width, rgb);
            const float share = static_cast<float>(a.texture.matte[soft.index]) / 255.0f;
            float* out = a.frame + 3 * frame_index(a, soft.index);
            for (int c = 0; c < 3; ++c) {
                const float f = out[c];
                if (!finite(f)) {
                    out[c] = rgb[c];
                    continue;
                }
                const float mixed = f + share * (rgb[c] - soft.old_surface[c]);
                out[c] = f >= 0 ? larger(0.0f, mixed) : mixed;
            }
        });
    }
};

struct RollOffArgs {
    float* frame;
    const u8* touched;
    int width;
    int x0, y0, x1, y1;  ///< The box of the mattes.
    float knee;
    u64* exceeded;  ///< Zeroed.
};

struct RollOff {
    using Args = RollOffArgs;
    static constexpr int kThreads = 256;
    struct Shared {
        u32 exceeded[kThreads];
    };

    static int blocks(const Args& a) { return ceil_div((a.x1 - a.x0) * (a.y1 - a.y0), kThreads); }

    template <class Block>
    WEFT_HD static void run(Block& block, Shared& s, const Args& a) {
        block.each([&](int t) {
            const int i = block.index() * kThreads + t, w = a.x1 - a.x0;
            s.exceeded[t] = 0;
            if (i >= w * (a.y1 - a.y0)) return;
            const u64 at = static_cast<u64>(a.y0 + i / w) * static_cast<u64>(a.width) +
                           static_cast<u64>(a.x0 + i % w);
            if (a.touched[at] != 0) s.exceeded[t] = roll(a.frame + 3 * at, a.touched[at], a.knee);
        });
        for (int half = kThreads / 2; half > 0; half /= 2) {
            block.each([&](int t) {
                if (t < half) s.exceeded[t] += s.exceeded[t + half];
            });
        }
        block.each([&](int t) {
            if (t == 0 && s.exceeded[0] != 0) atomic_add(a.exceeded, u64{s.exceeded[0]});
        });
    }

  private:
    // Returns 1 where the pixel exceeded 1.
    WEFT_HD static u32 roll(float* p, u8 matte, float knee) {
        const float highest = fmaxf(fmaxf(p[0], p[1]), p[2]);
        if (!(highest > knee)) return 0;
        const float room = 1.0f - knee;
        const float over = (highest - knee) / room;
        const float rolled = finite(over) ? knee + room * (over / (1.0f + over)) : 1.0f;
        const float share = static_cast<float>(matte) / 255.0f;
        for (int c = 0; c < 3; ++c) {
            const float to = finite(p[c]) && finite(highest) ? p[c] * (rolled / highest)
                             : p[c] > 0                      ? 1.0f
                                                             : 0.0f;
            p[c] = finite(p[c]) && matte < 255 ? p[c] + share * (to - p[c]) : to;
        }
        return highest > 1.0f;
    }
};

}  // namespace weft::kernels

#pragma once
// Backend::sample_plane() for one pixel: the operations of engine/compute/plane_sampler.inl in the
// same order, one channel after the other, so that the same bits come out.

#include <cmath>

#include "gpu/kernels/portable.h"

namespace weft::kernels {

constexpr int kMostLevels = 20;

struct alignas(16) Texel {
    float v[4];
};

struct Level {
    const Texel* texels;
    int width, height;
    float scale_x, scale_y;  ///< From texels of the plane to this level's.
};

enum Wrap : int { kWrapRepeat, kWrapMirror, kWrapClamp };

struct SampleArgs {
    Level levels[kMostLevels];
    int level_count;
    int plane_level;  ///< The levels before it are finer than the plane.
    int wrap;
    int fewest, most;  ///< Cells along one axis of a pixel.
    const float* coords;
    const u8* matte;
    int width, height;
    float* out;  ///< Three floats for each pixel.
};

struct Float2 {
    float x, y;
};

class PixelSampler {
  public:
    WEFT_HD explicit PixelSampler(const SampleArgs& a) : a_(a) {}

    /// The texture at pixel (x, y), never negative.
    WEFT_HD void sample(int x, int y, float* rgb) const {
        rgb[0] = rgb[1] = rgb[2] = 0;
        const Float2 jx = slope(larger(0, x - 1), y, smaller(a_.width - 1, x + 1), y);
        const Float2 jy = slope(x, larger(0, y - 1), x, smaller(a_.height - 1, y + 1));
        const float lx = sqrtf(jx.x * jx.x + jx.y * jx.y);
        const float ly = sqrtf(jy.x * jy.x + jy.y * jy.y);
        const float* centre = coord(x, y);
        const bool known = fabsf(centre[0]) < 1e9f && fabsf(centre[1]) < 1e9f;
        if (!(known && lx < 1e6f && ly < 1e6f)) return;
        const int nx = cells(lx), ny = cells(ly);
        const float cell = larger(lx / static_cast<float>(nx), ly / static_cast<float>(ny));
        int level = a_.plane_level;
        for (float span = 1.0f; cell > span && level + 1 < a_.level_count; span *= 2)
            ++level;
        const float finer = finer_levels(smaller(lx, ly), cell);
        level -= static_cast<int>(finer);
        at_level(a_.levels[level], centre, jx, jy, nx, ny, rgb);
        const float share = finer - floorf(finer);
        if (share > 0) {
            float next[3];
            at_level(a_.levels[level - 1], centre, jx, jy, nx, ny, next);
            for (int c = 0; c < 3; ++c)
                rgb[c] = rgb[c] + share * (next[c] - rgb[c]);
        }
        for (int c = 0; c < 3; ++c)
            rgb[c] = larger(0.0f, rgb[c]);
    }

  private:
    WEFT_HD float finer_levels(float shortest, float cell) const {
        float out = 0, span = 1;
        for (int k = 0; k < a_.plane_level; ++k, span *= 0.5f) {
            const float share =
                held(smaller(2 - 2 * shortest / span, 2 - 2 * cell / span), 0.0f, 1.0f);
            out += share;
            if (share < 1) break;
        }
        return out;
    }

    WEFT_HD void at_level(const Level& l, const float* centre, Float2 jx, Float2 jy, int nx, int ny,
                          float* rgb) const {
        const Level& plane = a_.levels[a_.plane_level];
        const Float2 at{folded(centre[0], plane.width) * l.scale_x,
                        folded(centre[1], plane.height) * l.scale_y};
        const Float2 step_x{jx.x * l.scale_x / static_cast<float>(nx),
                            jx.y * l.scale_y / static_cast<float>(nx)};
        const Float2 step_y{jy.x * l.scale_x / static_cast<float>(ny),
                            jy.y * l.scale_y / static_cast<float>(ny)};
        const float half_x = 0.5f * static_cast<float>(nx - 1);
        const float half_y = 0.5f * static_cast<float>(ny - 1);
        const Float2 first{at.x - step_x.x * half_x - step_y.x * half_y,
                           at.y - step_x.y * half_x - step_y.y * half_y};
        sum(l, at, first, step_x, step_y, nx, ny, rgb);
        const float share = 1.0f / static_cast<float>(nx * ny);
        for (int c = 0; c < 3; ++c)
            rgb[c] *= share;
    }

    WEFT_HD const float* coord(int x, int y) const {
        return a_.coords +
               2 * (static_cast<u64>(y) * static_cast<u64>(a_.width) + static_cast<u64>(x));
    }

    // Half of the difference between the neighbours, one-sided at the border.
    WEFT_HD Float2 slope(int xa, int ya, int xb, int yb) const {
        const float *p = coord(xa, ya), *q = coord(xb, yb);
        const float steps = static_cast<float>(larger(1, (xb - xa) + (yb - ya)));
        return {(q[0] - p[0]) / steps, (q[1] - p[1]) / steps};
    }

    WEFT_HD int cells(float texels) const {
        return held(static_cast<int>(ceilf(2 * texels)), a_.fewest, a_.most);
    }

    // Within one period of the plane, so that the coordinate keeps its precision.
    WEFT_HD float folded(float u, int n) const {
        if (a_.wrap == kWrapClamp) return held(u, -1.0f, static_cast<float>(n) + 1);
        const float period = static_cast<float>(a_.wrap == kWrapMirror ? 2 * n : n);
        return u - period * floorf(u / period);
    }

    WEFT_HD int wrapped(int i, int n) const {
        if (a_.wrap == kWrapClamp) return held(i, 0, n - 1);
        const int period = a_.wrap == kWrapMirror ? 2 * n : n;
        i %= period;
        if (i < 0) i += period;
        return i < n ? i : 2 * n - 1 - i;
    }

    // Cubic convolution (Keys 1981) with a = −0.5, as polynomials in the fraction.
    WEFT_HD static void cubic_weights(float f, float* w) {
        w[0] = 0.0f + f * (-0.5f + f * (1.0f + f * -0.5f));
        w[1] = 1.0f + f * (0.0f + f * (-2.5f + f * 1.5f));
        w[2] = 0.0f + f * (0.5f + f * (2.0f + f * -1.5f));
        w[3] = 0.0f + f * (0.0f + f * (-0.5f + f * 0.5f));
    }

    // Sums of the even and of the odd columns, which are added to each other at the end.
    struct Pair {
        float even[3], odd[3];
    };

    WEFT_HD void add_lookup(const Level& l, Float2 p, bool inside, Pair& total) const {
        const float gx = p.x - 0.5f, gy = p.y - 0.5f;
        const float bx = floorf(gx), by = floorf(gy);
        float wx[4], wy[4];
        cubic_weights(gx - bx, wx);
        cubic_weights(gy - by, wy);
        const int x = static_cast<int>(bx) - 1, y = static_cast<int>(by) - 1;
        int column[4];
        for (int k = 0; k < 4; ++k)
            column[k] = inside ? x + k : wrapped(x + k, l.width);
        float found[4][3] = {};
        for (int k = 0; k < 4; ++k) {
            const int row = inside ? y + k : wrapped(y + k, l.height);
            const Texel* texels = l.texels + static_cast<u64>(row) * static_cast<u64>(l.width);
            for (int i = 0; i < 4; ++i) {
                const Texel t = texels[column[i]];
                for (int c = 0; c < 3; ++c)
                    found[i][c] += wy[k] * t.v[c];
            }
        }
        for (int c = 0; c < 3; ++c) {
            total.even[c] += wx[0] * found[0][c];
            total.odd[c] += wx[1] * found[1][c];
            total.even[c] += wx[2] * found[2][c];
            total.odd[c] += wx[3] * found[3][c];
        }
    }

    WEFT_HD void sum(const Level& l, Float2 at, Float2 first, Float2 step_x, Float2 step_y, int nx,
                     int ny, float* rgb) const {
        const float reach_x = fabsf(at.x - first.x) + fabsf(step_x.x) * static_cast<float>(nx) +
                              fabsf(step_y.x) * static_cast<float>(ny) + 2;
        const float reach_y = fabsf(at.y - first.y) + fabsf(step_x.y) * static_cast<float>(nx) +
                              fabsf(step_y.y) * static_cast<float>(ny) + 2;
        const bool inside = at.x - reach_x >= 0 && at.y - reach_y >= 0 &&
                            at.x + reach_x < static_cast<float>(l.width) &&
                            at.y + reach_y < static_cast<float>(l.height);
        Pair total{};
        for (int j = 0; j < ny; ++j) {
            Float2 p{first.x + step_y.x * static_cast<float>(j),
                     first.y + step_y.y * static_cast<float>(j)};
            for (int i = 0; i < nx; ++i, p.x += step_x.x, p.y += step_x.y)
                add_lookup(l, p, inside, total);
        }
        for (int c = 0; c < 3; ++c)
            rgb[c] = total.even[c] + total.odd[c];
    }

    const SampleArgs& a_;
};

/// The texture alone.
struct SamplePlane {
    using Args = SampleArgs;
    static constexpr int kThreads = 128;
    struct Shared {};

    static int blocks(const Args& a) { return ceil_div(a.width * a.height, kThreads); }

    template <class Block>
    WEFT_HD static void run(Block& block, Shared&, const Args& a) {
        block.each([&](int t) {
            const int i = block.index() * kThreads + t;
            if (i >= a.width * a.height || a.matte[i] == 0) return;
            PixelSampler(a).sample(i % a.width, i / a.width, a.out + 3 * static_cast<u64>(i));
        });
    }
};

}  // namespace weft::kernels

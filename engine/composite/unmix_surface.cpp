#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/composite/colour_statistics.h"
#include "engine/composite/composite.h"
#include "engine/core/finite_rgb.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr int kReach_px = 96;  // how far from soft pixels whole ones are used
constexpr float kNoiseOfLevel =
    0.02f;                          // of the plate's own level: grain, compression, matte errors
constexpr float kMinNoise = 1e-4f;  // linear light
// Of either side's colours: beyond, a colour is not counted as theirs.
constexpr float kMaxDeviations = 2.0f;
// Standard deviation of a matte value, greatest at one half.
constexpr float kMatteError = 0.2f;
constexpr float kSureWeight =
    1e-4f;  // of surroundings, as found 30 px away; below this they are not reliable

// Copies what is known and returns the box of the pixels that have to be estimated.
Recti copy_surface(ViewF3 plate, ViewU8x1 matte, ImageF3& surface) {
    std::vector<Recti> rows(static_cast<std::size_t>(matte.height()));
    parallel_rows(matte.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const std::uint8_t* m = matte.row(y);
            Recti& wanted = rows[static_cast<std::size_t>(y)];
            for (int x = 0; x < matte.width(); ++x) {
                if (m[x] == 0) continue;
                const float* p = plate.pixel(x, y);
                if (m[x] == 255 && finite_rgb(p)) {
                    std::copy(p, p + 3, surface.pixel(x, y));
                } else {
                    if (wanted.empty()) wanted = {x, y, x + 1, y + 1};
                    wanted.x1 = x + 1;
                }
            }
        }
    });
    Recti box;
    for (const Recti& r : rows)
        box = box.united(r);
    return box;
}

// The B that makes O = F + M (T − B) the most likely picture. The pixel's colour is explained as F
// = (M + δ) B + (1 − M − δ) G, with B and G normally distributed around the colours on either side
// (maximum a posteriori, Chuang et al. 2001, eq. 9, with variances in place of covariances) and δ
// the error of the matte. A plain surface keeps its smooth B. A patterned one takes the pixel's own
// pattern, so that the pattern does not show through the edge. What a matte that is too wide or too
// narrow leaves counts as B too, so that it makes no fringe.
float likely_surface(const NearColours& around, float f, float m, int c) {
    const float b = around.surface.mean(c);
    const float near_surroundings = std::min(1.0f, around.surroundings.weight() / kSureWeight);
    if (near_surroundings < 1e-6f) return b;
    const float g = around.surroundings.mean(c);
    const float noise = std::max(kMinNoise, kNoiseOfLevel * std::max(std::abs(b), std::abs(g)));
    const float var_b = around.surface.variance(c);
    const float far = 1.0f / near_surroundings - 1.0f;
    const float var_g = around.surroundings.variance(c) + noise * noise + far * (g * g + b * b);
    const float rest = f - m * b - (1.0f - m) * g;
    const float error = 4.0f * kMatteError * m * (1.0f - m) * std::abs(b - g);
    const float explained =
        m * m * var_b + (1.0f - m) * (1.0f - m) * var_g + error * error + noise * noise;
    const float limit = kMaxDeviations * std::sqrt(var_b);
    const float of_surface = std::clamp(rest * m * var_b / explained, -limit, limit);
    const float most = (rest > 0) == (b > g) ? 1.0f - m : m;
    const float of_matte = std::clamp(rest * error * error / explained, -most * std::abs(b - g),
                                      most * std::abs(b - g));
    // The remainder is the surroundings' own detail; it is smaller where the surface is certain.
    const float remainder = rest - m * of_surface - of_matte;
    const float detail = (1.0f - m) / m * kMaxDeviations * std::sqrt(var_g);
    const float excess = remainder - std::clamp(remainder, -detail, detail);
    return b + of_surface + (of_matte + excess) / m;
}

}  // namespace

ImageF3 unmix_surface(ViewF3 plate, ViewU8x1 matte) {
    ImageF3 surface(plate.size());
    const Recti wanted = copy_surface(plate, matte, surface);
    if (wanted.empty()) return surface;
    const ColourPyramid pyramid(plate, matte,
                                wanted.grown(kReach_px).intersected(rect_of(plate.size())));
    parallel_rows(wanted.height(), 4, [&](int r0, int r1) {
        for (int y = wanted.y0 + r0; y < wanted.y0 + r1; ++y) {
            const std::uint8_t* m = matte.row(y);
            for (int x = wanted.x0; x < wanted.x1; ++x) {
                if (m[x] == 0) continue;
                const float* p = plate.pixel(x, y);
                const bool usable = finite_rgb(p);
                if (m[x] == 255 && usable) continue;
                const NearColours around = pyramid.near(x, y);
                float* b = surface.pixel(x, y);
                if (!(around.surface.weight() > 0)) {
                    // Nothing is known of the surface: B = F gives the plain mix.
                    if (usable) std::copy(p, p + 3, b);
                    continue;
                }
                for (int c = 0; c < 3; ++c) {
                    b[c] = usable
                               ? likely_surface(around, p[c], static_cast<float>(m[x]) / 255.0f, c)
                               : around.surface.mean(c);
                }
            }
        }
    });
    return surface;
}

// With coverage a, what is shown e > a and the background G = (F − a B) / (1 − a):
// O = e T + (1 − e) G = F + e (T − B′), where e B′ = F − (1 − e) G.
ImageF3 unmix_surface(ViewF3 plate, ViewU8x1 matte, ViewU8x1 shown) {
    ImageF3 surface = unmix_surface(plate, matte);
    parallel_rows(plate.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < plate.width(); ++x) {
                const int covered = matte.row(y)[x], wanted = shown.row(y)[x];
                if (wanted <= covered) continue;
                const float a = static_cast<float>(covered) / 255.0f;
                const float e = static_cast<float>(wanted) / 255.0f;
                const float* f = plate.pixel(x, y);
                float* b = surface.pixel(x, y);
                for (int c = 0; c < 3; ++c) {
                    if (!std::isfinite(f[c])) continue;
                    const float background = covered == 0 ? f[c] : (f[c] - a * b[c]) / (1 - a);
                    b[c] = (f[c] - (1 - e) * background) / e;
                }
            }
        }
    });
    return surface;
}

}  // namespace weft

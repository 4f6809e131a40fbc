#include "engine/metrics/ideal.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/core/wrap.h"
#include "engine/metrics/region.h"

namespace weft {
namespace {

constexpr int kBorder = 4;  // Half the widest kernel.
constexpr int kMaxSamples = 64;

double decode(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double encode(double linear) {
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

// Where the pixel's centre lies on the plane, and what one pixel to the right and down adds.
struct Footprint {
    Vec2 centre, right, down;
};

// ∂d/∂axis at (x, y) from the valid neighbours on both sides, on one side, or 0 without any.
Vec2 slope(const FlowField& f, int x, int y, int dx, int dy) {
    const auto inside = [&](int u, int v) {
        return u >= 0 && v >= 0 && u < f.d.width() && v < f.d.height() && f.valid.at(u, v) != 0;
    };
    const auto at = [&](int u, int v) { return Vec2(f.d.at(u, v, 0), f.d.at(u, v, 1)); };
    const bool before = inside(x - dx, y - dy);
    const bool after = inside(x + dx, y + dy);
    if (before && after) return 0.5f * (at(x + dx, y + dy) - at(x - dx, y - dy));
    if (after) return at(x + dx, y + dy) - at(x, y);
    if (before) return at(x, y) - at(x - dx, y - dy);
    return {0, 0};
}

Footprint footprint(const FlowField& f, const TextureMapping& mapping, int x, int y) {
    const Vec2 q = Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) +
                   Vec2(f.d.at(x, y, 0), f.d.at(x, y, 1));
    const TextureMapping::Linear at = mapping.linear_at(q);
    return {at.texel, at.step(Vec2(1, 0) + slope(f, x, y, 1, 0)),
            at.step(Vec2(0, 1) + slope(f, x, y, 0, 1))};
}

int samples_along(Vec2 step, int least) {
    const float texels = std::hypot(step.x, step.y);
    if (!(texels < static_cast<float>(kMaxSamples))) return kMaxSamples;
    return std::clamp(static_cast<int>(std::ceil(2.0f * texels)), least, kMaxSamples);
}

template <int C, Kernel K>
void add_lookup(ImageView<const float, C> padded, Size plane, Vec2 uv, float* sum) {
    constexpr int kTaps = kernel_taps(K);
    const float w = static_cast<float>(plane.width);
    const float h = static_cast<float>(plane.height);
    const float x = uv.x - std::floor(uv.x / w) * w - 0.5f;
    const float y = uv.y - std::floor(uv.y / h) * h - 0.5f;
    const float fx = std::floor(x);
    const float fy = std::floor(y);
    // Rounding may leave x = w − 0.5 exactly; the border holds that texel too.
    const int ix = std::clamp(static_cast<int>(fx), -1, plane.width - 1) + kBorder - kTaps / 2 + 1;
    const int iy = std::clamp(static_cast<int>(fy), -1, plane.height - 1) + kBorder - kTaps / 2 + 1;
    std::array<float, kTaps> wx;
    std::array<float, kTaps> wy;
    kernel_weights(K, x - fx, wx.data());
    kernel_weights(K, y - fy, wy.data());
    for (int c = 0; c < C; ++c) {
        float total = 0;
        for (std::size_t j = 0; j < kTaps; ++j) {
            const float* p = padded.pixel(ix, iy + static_cast<int>(j)) + c;
            float line = 0;
            for (std::size_t i = 0; i < kTaps; ++i)
                line += wx[i] * p[i * C];
            total += wy[j] * line;
        }
        sum[c] += total;
    }
}

template <int C, Kernel K>
Image<float, C> render_with(ImageView<const float, C> padded, Size plane, const FlowField& field,
                            const TextureMapping& mapping, int least_samples) {
    Image<float, C> out(field.size());
    parallel_rows(out.height(), 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.width(); ++x) {
                if (field.valid.at(x, y) == 0) continue;
                const Footprint f = footprint(field, mapping, x, y);
                if (!std::isfinite(f.centre.x) || !std::isfinite(f.centre.y)) continue;
                const int nx = samples_along(f.right, least_samples);
                const int ny = samples_along(f.down, least_samples);
                std::array<float, C> sum{};
                for (int j = 0; j < ny; ++j) {
                    const float sy = (static_cast<float>(j) + 0.5f) / static_cast<float>(ny) - 0.5f;
                    for (int i = 0; i < nx; ++i) {
                        const float sx =
                            (static_cast<float>(i) + 0.5f) / static_cast<float>(nx) - 0.5f;
                        add_lookup<C, K>(padded, plane, f.centre + sx * f.right + sy * f.down,
                                         sum.data());
                    }
                }
                const float n = static_cast<float>(nx * ny);
                for (std::size_t c = 0; c < C; ++c)
                    out.pixel(x, y)[c] = sum[c] / n;
            }
        }
    });
    return out;
}

template <int C>
Image<float, C> render_kernel(Kernel kernel, ImageView<const float, C> padded, Size plane,
                              const FlowField& field, const TextureMapping& m, int samples) {
    switch (kernel) {
        case Kernel::kBilinear:
            return render_with<C, Kernel::kBilinear>(padded, plane, field, m, samples);
        case Kernel::kCatmullRom:
            return render_with<C, Kernel::kCatmullRom>(padded, plane, field, m, samples);
        case Kernel::kLanczos4:
            break;
    }
    return render_with<C, Kernel::kLanczos4>(padded, plane, field, m, samples);
}

}  // namespace

IdealTexture::IdealTexture(ViewU8x3 plane, IdealFilter filter)
    : filter_(filter),
      size_(plane.size()),
      rgb_(plane.width() + 2 * kBorder, plane.height() + 2 * kBorder) {
    std::array<float, 256> value;
    for (std::size_t i = 0; i < 256; ++i) {
        const double v = static_cast<double>(i) / 255.0;
        value[i] = static_cast<float>(filter.linear_light ? decode(v) : v);
    }
    for (int y = 0; y < rgb_.height(); ++y) {
        for (int x = 0; x < rgb_.width(); ++x) {
            const std::uint8_t* p = plane.pixel(wrapped(x - kBorder, plane.width()),
                                                wrapped(y - kBorder, plane.height()));
            for (int c = 0; c < 3; ++c)
                rgb_.pixel(x, y)[c] = value[p[c]];
        }
    }
    if (!filter.linear_light) luma_ = luma_8bit(rgb_);
}

ImageF3 IdealTexture::render(const FlowField& ref_from_cur, const TextureMapping& mapping) const {
    ImageF3 out = render_kernel<3>(filter_.kernel, rgb_, size_, ref_from_cur, mapping,
                                   filter_.samples_per_axis);
    if (!filter_.linear_light) return out;
    parallel_rows(out.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int i = 0; i < 3 * out.width(); ++i)
                out.row(y)[i] = static_cast<float>(encode(static_cast<double>(out.row(y)[i])));
        }
    });
    return out;
}

ImageF1 IdealTexture::render_luma(const FlowField& ref_from_cur,
                                  const TextureMapping& mapping) const {
    if (filter_.linear_light) return luma_8bit(render(ref_from_cur, mapping));
    return render_kernel<1>(filter_.kernel, luma_, size_, ref_from_cur, mapping,
                            filter_.samples_per_axis);
}

FlowField reference_field(ViewU8x1 matte) {
    FlowField f(matte.size());
    f.valid = eroded_inside(matte, 0);
    return f;
}

}  // namespace weft

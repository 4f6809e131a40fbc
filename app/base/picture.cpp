#include "app/base/picture.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#include "engine/color/color_space.h"

namespace weft {

std::uint64_t next_picture_id() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

float half_to_float(std::uint16_t half) {
    const std::uint32_t sign = std::uint32_t{half & 0x8000u} << 16;
    const int exponent = (half >> 10) & 31;
    const std::uint32_t mantissa = half & 1023u;
    if (exponent == 0) {
        const float small = std::ldexp(static_cast<float>(mantissa), -24);
        return sign ? -small : small;
    }
    if (exponent == 31) return std::bit_cast<float>(sign | 0x7F800000u | (mantissa << 13));
    const auto exponent_bits = static_cast<std::uint32_t>(exponent + 112) << 23;
    return std::bit_cast<float>(sign | exponent_bits | (mantissa << 13));
}

std::uint16_t float_to_half(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const auto sign = static_cast<std::uint16_t>((bits >> 16) & 0x8000u);
    const float magnitude = std::abs(value);
    if (std::isnan(value)) return 0;  // Shown as black; the pixel read-out shows NaN.
    if (magnitude >= 65504.0f) return static_cast<std::uint16_t>(sign | 0x7BFFu);
    if (magnitude < 6.1035156e-5f) {
        return static_cast<std::uint16_t>(
            sign | static_cast<std::uint16_t>(std::lround(magnitude * 16777216.0f)));
    }
    // Rounds half up: exact enough for display.
    const std::uint32_t rounded = (bits & 0x7FFFFFFFu) + 0x1000u;
    return static_cast<std::uint16_t>(sign | ((rounded - 0x38000000u) >> 13));
}

Vec3 Picture::at(int x, int y) const {
    if (!srgb.empty()) {
        const std::uint8_t* p = srgb.pixel(x, y);
        return Vec3(p[0], p[1], p[2]) / 255.0f;
    }
    if (half.empty()) return {};
    const std::uint16_t* p = half.pixel(x, y);
    return {linear_to_srgb(half_to_float(p[0])), linear_to_srgb(half_to_float(p[1])),
            linear_to_srgb(half_to_float(p[2]))};
}

PicturePtr make_picture(const ImageF3& pixels, bool eight_bit, const ColorTransform* srgb_from,
                        const ColorTransform* linear_from) {
    auto out = std::make_shared<Picture>();
    out->id = next_picture_id();
    out->size = pixels.size();
    const ColorTransform* transform = eight_bit ? srgb_from : linear_from;
    const std::size_t count = pixels.size_bytes() / sizeof(float);
    ImageF3 moved;
    const float* from = pixels.data();
    if (transform && !transform->identity()) {
        moved = pixels;
        transform->apply(moved);
        from = moved.data();
    }
    if (eight_bit) {
        out->srgb = ImageU8x3(pixels.size());
        std::transform(from, from + count, out->srgb.data(), [](float v) {
            return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f);
        });
    } else {
        out->half = Image<std::uint16_t, 3>(pixels.size());
        std::transform(from, from + count, out->half.data(), float_to_half);
    }
    return out;
}

PicturePtr make_picture(ImageU8x3 srgb) {
    auto out = std::make_shared<Picture>();
    out->id = next_picture_id();
    out->size = srgb.size();
    out->srgb = std::move(srgb);
    return out;
}

ImageU8x3 shrink(ViewU8x3 picture, int longest) {
    const int side = std::max(picture.width(), picture.height());
    if (side <= longest || longest < 1) {
        ImageU8x3 copy(picture.size());
        for (int y = 0; y < picture.height(); ++y)
            std::copy_n(picture.row(y), 3 * picture.width(), copy.row(y));
        return copy;
    }
    const auto scaled = [&](int length) {
        return std::max(1, static_cast<int>(std::int64_t{length} * longest / side));
    };
    ImageU8x3 out(scaled(picture.width()), scaled(picture.height()));
    for (int y = 0; y < out.height(); ++y) {
        const int y0 = y * picture.height() / out.height();
        const int y1 = std::max(y0 + 1, (y + 1) * picture.height() / out.height());
        for (int x = 0; x < out.width(); ++x) {
            const int x0 = x * picture.width() / out.width();
            const int x1 = std::max(x0 + 1, (x + 1) * picture.width() / out.width());
            int sum[3] = {0, 0, 0};
            for (int v = y0; v < y1; ++v)
                for (int u = x0; u < x1; ++u)
                    for (int c = 0; c < 3; ++c)
                        sum[c] += picture.pixel(u, v)[c];
            const int area = (y1 - y0) * (x1 - x0);
            for (int c = 0; c < 3; ++c)
                out.pixel(x, y)[c] = static_cast<std::uint8_t>((sum[c] + area / 2) / area);
        }
    }
    return out;
}

ImageU8x3 shrink(const Picture& picture, int longest) {
    if (!picture.srgb.empty()) return shrink(picture.srgb.view(), longest);
    ImageU8x3 codes(picture.size);
    for (int y = 0; y < picture.size.height; ++y) {
        for (int x = 0; x < picture.size.width; ++x) {
            const Vec3 v = picture.at(x, y);
            for (int c = 0; c < 3; ++c)
                codes.pixel(x, y)[c] =
                    static_cast<std::uint8_t>(std::clamp(v[c], 0.0f, 1.0f) * 255.0f + 0.5f);
        }
    }
    return shrink(codes.view(), longest);
}

}  // namespace weft

#include "engine/mask/scene_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "engine/core/block_means.h"
#include "engine/core/luma.h"
#include "engine/core/parallel.h"

namespace weft {

ImageF3 reduced_floats(ViewU8x3 frame, int step) {
    ImageF3 out(frame.size());
    for (int y = 0; y < frame.height(); ++y)
        std::copy_n(frame.row(y), 3 * static_cast<std::size_t>(frame.width()), out.row(y));
    return block_means(out, step);
}

Vec3 color_at(const ImageF3& picture, int x, int y) {
    const float* c = picture.pixel(x, y);
    return {c[0], c[1], c[2]};
}

ImageF1 luma_of(const ImageF3& picture) {
    ImageF1 out(picture.size());
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            out.at(x, y) = luma_709(picture.pixel(x, y));
    return out;
}

Matte luma_codes(ViewU8x3 frame) {
    Matte out(frame.size());
    parallel_rows(out.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const std::uint8_t* p = frame.row(y);
            for (int x = 0; x < out.width(); ++x, p += 3)
                out.at(x, y) = static_cast<std::uint8_t>(std::lround(luma_709(
                    static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]))));
        }
    });
    return out;
}

bool shows_anything(const ImageF1& luma) {
    constexpr float kDark = 8;  // code
    const float* codes = luma.data();
    const std::size_t count = luma.size_bytes() / sizeof(float);
    return 2 * static_cast<std::size_t>(
                   std::count_if(codes, codes + count, [](float code) { return code > kDark; })) >
           count;
}

}  // namespace weft

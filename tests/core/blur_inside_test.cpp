#include "engine/core/blur_inside.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/core/rng.h"

namespace weft {
namespace {

// The weighted mean as its definition says, term by term: along the rows, then along the columns.
ImageF3 by_definition(const ImageF3& picture, const Matte& matte, float sigma_px) {
    const std::vector<float> kernel = gaussian_kernel(sigma_px);
    const int r = static_cast<int>(kernel.size() / 2);
    const int w = picture.width(), h = picture.height();
    Image<float, 4> rows(picture.size());
    ImageF3 out = picture;
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            for (int u = std::max(0, x - r); u <= std::min(w - 1, x + r); ++u) {
                if (matte.at(u, y) == 0) continue;
                const float k = kernel[static_cast<std::size_t>(u - x + r)];
                for (int c = 0; c < 3; ++c)
                    rows.at(x, y, c) += k * picture.at(u, y, c);
                rows.at(x, y, 3) += k;
            }
        }
    }
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            if (matte.at(x, y) == 0) continue;
            float sum[4] = {0, 0, 0, 0};
            for (int v = std::max(0, y - r); v <= std::min(h - 1, y + r); ++v) {
                for (int c = 0; c < 4; ++c)
                    sum[c] += kernel[static_cast<std::size_t>(v - y + r)] * rows.at(x, v, c);
            }
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = sum[c] / sum[3];
        }
    }
    return out;
}

TEST(BlurInside, GivesTheBitsOfItsDefinition) {
    for (const Size size : {Size{31, 17}, Size{4, 40}, Size{1, 1}}) {
        ImageF3 picture(size);
        Matte matte(size);
        Rng rng(3, 1, 4, static_cast<std::uint64_t>(size.width));
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                for (int c = 0; c < 3; ++c)
                    picture.at(x, y, c) = static_cast<float>(rng.below(1000)) / 700.0f - 0.1f;
                matte.at(x, y) = rng.below(4) == 0 ? 0 : 255;
            }
        }
        matte.at(0, 0) = 255;
        for (const float sigma_px : {0.3f, 1.1f, 4.0f}) {
            const ImageF3 expected = by_definition(picture, matte, sigma_px);
            ImageF3 blurred = picture;
            blur_inside(blurred, matte, sigma_px);
            EXPECT_EQ(blurred, expected);
        }
    }
}

}  // namespace
}  // namespace weft

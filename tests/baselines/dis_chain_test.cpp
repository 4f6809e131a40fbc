#include "bench/baselines/dis_chain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kFrame{160, 120};
constexpr Vec2 kStep_px{3, 2};

ImageU8x3 frame_of(int t) {
    const WaveTexture texture(8);
    ImageU8x3 out(kFrame);
    for (int y = 0; y < kFrame.height; ++y) {
        for (int x = 0; x < kFrame.width; ++x)
            std::fill_n(out.pixel(x, y), 3,
                        code_of(texture(centre_of(x, y) - static_cast<float>(t) * kStep_px)));
    }
    return out;
}

TEST(DisChain, CarriesThePictureWithTheFrameInsideTheMatte) {
    const ImageU8x3 picture = frame_of(0);  // shown over itself: what moves is the frame
    DisChain chain(frame_of(0), picture);
    Matte left(kFrame);
    for (int y = 0; y < kFrame.height; ++y)
        std::fill_n(left.row(y), kFrame.width / 2, std::uint8_t{255});
    ImageU8x3 shown;
    for (int t = 1; t <= 3; ++t)
        shown = chain.next(frame_of(t), left);
    const ImageU8x3 moved = frame_of(3);
    double inside = 0;
    for (int y = 30; y < 90; ++y) {
        for (int x = 30; x < 70; ++x)
            inside += std::abs(shown.at(x, y) - moved.at(x, y));
        for (int x = 90; x < 130; ++x)
            ASSERT_EQ(shown.at(x, y), moved.at(x, y));
    }
    EXPECT_LT(inside / (60 * 40), 6);
}

}  // namespace
}  // namespace weft

#include "tests/cli/card_scene.h"

#include <algorithm>
#include <cmath>

#include "engine/core/rng.h"

namespace weft::test {
namespace {

// Uniform in [0, 1) by position, constant over cells of `cell` pixels.
double cell_noise(std::uint64_t seed, int x, int y, int cell) {
    Rng rng(seed, static_cast<std::uint64_t>(x / cell), static_cast<std::uint64_t>(y / cell),
            static_cast<std::uint64_t>(cell));
    return rng.uniform();
}

float code(double v) {
    return static_cast<float>(static_cast<int>(v * 255.0 + 0.5)) / 255.0f;
}

}  // namespace

bool Card::covers(int step, int x, int y) {
    const Vec2i c = corner(step);
    return x >= c.x && x < c.x + kWidth && y >= c.y && y < c.y + kHeight;
}

ImageF3 pattern_picture(Size size, std::uint64_t seed) {
    ImageF3 image(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const double coarse = cell_noise(seed, x, y, 11), fine = cell_noise(seed, x, y, 3);
            image.at(x, y, 0) = code(0.20 + 0.35 * coarse + 0.25 * fine);
            image.at(x, y, 1) = code(0.30 + 0.25 * coarse + 0.20 * fine);
            image.at(x, y, 2) = code(0.25 + 0.20 * fine + 0.25 * cell_noise(seed + 1, x, y, 7));
        }
    }
    return image;
}

ImageF3 card_plate(int step) {
    static const ImageF3 background = pattern_picture(Card::kPlate, 11);
    static const ImageF3 card = pattern_picture({Card::kWidth, Card::kHeight}, 23);
    ImageF3 plate = background;
    const Vec2i c = Card::corner(step);
    for (int y = 0; y < Card::kHeight; ++y)
        std::copy_n(card.row(y), 3 * Card::kWidth, plate.pixel(c.x, c.y + y));
    return plate;
}

Matte card_matte(int step) {
    Matte matte(Card::kPlate);
    for (int y = 0; y < matte.height(); ++y)
        for (int x = 0; x < matte.width(); ++x)
            matte.at(x, y) = Card::covers(step, x, y) ? 255 : 0;
    return matte;
}

ImageF3 smooth_plane(float period) {
    constexpr int kSide = 128;
    ImageF3 out(kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const float turn = 6.2831853f / period;
            const float u = turn * static_cast<float>(x), v = turn * static_cast<float>(y);
            out.at(x, y, 0) = 0.5f + 0.3f * std::sin(u);
            out.at(x, y, 1) = 0.5f + 0.3f * std::sin(v);
            out.at(x, y, 2) = 0.5f + 0.2f * std::sin(u + v);
        }
    }
    return out;
}

}  // namespace weft::test

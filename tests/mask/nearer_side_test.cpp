// A kerb above a pavement, both of grey grit, and pieces that come to light between them.
#include "engine/mask/nearer_side.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "engine/core/rng.h"

namespace weft {
namespace {

constexpr Size kStreet{160, 120};
constexpr int kKerbEnds = 60;

class NearerSide : public ::testing::Test {
  protected:
    // Grit of ±24 codes hides a step of 16 from any two pixels.
    ImageU8x3 street() const {
        ImageU8x3 out(kStreet);
        for (int y = 0; y < kStreet.height; ++y) {
            for (int x = 0; x < kStreet.width; ++x) {
                Rng grit(9, static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(x));
                const int code =
                    (y < kKerbEnds ? 120 : 136) + static_cast<int>(grit.below(49)) - 24;
                for (int c = 0; c < 3; ++c)
                    out.at(x, y, c) = static_cast<std::uint8_t>(code);
            }
        }
        return out;
    }
    // Pixels of `piece` that are left, while neither side is known of what is in it.
    int left(const Recti& piece, bool with_outside = true) const {
        ImageF1 phi(kStreet);
        Matte outside(kStreet), pieces(kStreet);
        for (int y = 0; y < kStreet.height; ++y) {
            for (int x = 0; x < kStreet.width; ++x) {
                const bool in = piece.contains(x, y), kerb = y < kKerbEnds;
                phi.at(x, y) = kerb && !in ? 5.0f : -5.0f;
                outside.at(x, y) = with_outside && !kerb && !in ? 255 : 0;
                pieces.at(x, y) = in ? 255 : 0;
            }
        }
        const ImageU8x3 frame = street();
        drop_nearer_outside({frame, phi, outside, 1}, pieces);
        int count = 0;
        for (int y = 0; y < kStreet.height; ++y)
            for (int x = 0; x < kStreet.width; ++x)
                count += pieces.at(x, y) != 0 ? 1 : 0;
        return count;
    }
};

TEST_F(NearerSide, PavementIsNoKerb) {
    EXPECT_EQ(left({60, kKerbEnds, 80, kKerbEnds + 14}), 0);
}

TEST_F(NearerSide, KerbStays) {
    EXPECT_EQ(left({60, kKerbEnds - 14, 80, kKerbEnds}), 20 * 14);
}

TEST_F(NearerSide, WhatIsMostlyKerbStaysWhole) {
    EXPECT_EQ(left({60, kKerbEnds - 12, 80, kKerbEnds + 2}), 20 * 14);
}

TEST_F(NearerSide, HalfOfPavementIsTooMuch) {
    EXPECT_EQ(left({60, kKerbEnds - 8, 80, kKerbEnds + 8}), 0);
}

TEST_F(NearerSide, NothingIsSaidWithoutAnOutside) {
    EXPECT_EQ(left({60, kKerbEnds, 80, kKerbEnds + 14}, false), 20 * 14);
}

TEST_F(NearerSide, AnEmptyMatteStaysEmpty) {
    EXPECT_EQ(left({}), 0);
}

}  // namespace
}  // namespace weft

#include "engine/mask/patch_difference.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

namespace weft {
namespace {

constexpr int kSide = 2 * kPatchRadius + 1;

int by_definition(const std::uint8_t* a, const std::uint8_t* b) {
    int sum = 0;
    for (int i = 0; i < kPatchValues; ++i)
        sum += std::abs(a[i] - b[i]);
    return sum;
}

// Pictures that are one patch and nothing more, so that reading beyond it is reading beyond the
// memory, which AddressSanitizer reports.
TEST(PatchDifference, IsTheSumOfTheAbsoluteDifferences) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> value(0, 255);
    for (int k = 0; k < 200; ++k) {
        std::vector<std::uint8_t> a(kPatchValues), b(kPatchValues);
        for (std::uint8_t& v : a)
            v = static_cast<std::uint8_t>(value(random));
        for (std::uint8_t& v : b)
            v = static_cast<std::uint8_t>(value(random));
        const std::ptrdiff_t middle = kPatchRadius * 3 * kSide + 3 * kPatchRadius;
        EXPECT_EQ(patch_difference(a.data() + middle, 3 * kSide, b.data() + middle, 3 * kSide,
                                   std::numeric_limits<int>::max()),
                  by_definition(a.data(), b.data()));
    }
}

TEST(PatchDifference, EveryValueCountsOnce) {
    const std::vector<std::uint8_t> black(kPatchValues);
    const std::ptrdiff_t middle = kPatchRadius * 3 * kSide + 3 * kPatchRadius;
    for (std::size_t i = 0; i < black.size(); ++i) {
        std::vector<std::uint8_t> one = black;
        one[i] = 255;
        EXPECT_EQ(patch_difference(black.data() + middle, 3 * kSide, one.data() + middle, 3 * kSide,
                                   std::numeric_limits<int>::max()),
                  255)
            << i;
    }
}

TEST(PatchDifference, StopsWhereItIsNotBelowTheBest) {
    const std::vector<std::uint8_t> black(kPatchValues), white(kPatchValues, 255);
    const std::ptrdiff_t middle = kPatchRadius * 3 * kSide + 3 * kPatchRadius;
    const int found =
        patch_difference(black.data() + middle, 3 * kSide, white.data() + middle, 3 * kSide, 100);
    EXPECT_GE(found, 100);
    EXPECT_LT(found, 255 * kPatchValues);
}

}  // namespace
}  // namespace weft

#include "engine/core/hash.h"

#include <gtest/gtest.h>

#include "engine/core/rng.h"

namespace weft {
namespace {

TEST(Hash, IsTheSameEverywhere) {
    Hasher hasher;
    hasher.text("weft").value(std::int32_t{7});
    // A change of this value breaks every cache and every recorded texture id.
    EXPECT_EQ(hasher.finish().hex(), "e4ce4327b863b213948bf6739bf28153");
}

TEST(Hash, LengthsSeparateTexts) {
    Hasher a, b;
    a.text("ab").text("c");
    b.text("a").text("bc");
    EXPECT_NE(a.finish(), b.finish());
}

TEST(Rng, DependsOnKeyAndPositionOnly) {
    Rng a(1, 2, 3, 4), b(1, 2, 3, 4), other(1, 2, 4, 3);
    a.next();
    b.next();
    EXPECT_EQ(a.next(), b.next());
    EXPECT_NE(a.next(), other.next());
}

TEST(Rng, BelowStaysBelow) {
    Rng rng(9);
    int counts[7] = {};
    for (int i = 0; i < 7000; ++i)
        ++counts[rng.below(7)];
    for (const int c : counts) {
        EXPECT_GT(c, 850);
        EXPECT_LT(c, 1150);
    }
}

}  // namespace
}  // namespace weft

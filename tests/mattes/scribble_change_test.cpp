// Scribbles on a matte that is painted already: what no line touches stays as it was painted.
#include "app/mattes/scribble_change.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "app/mattes/scribble_matte.h"
#include "tests/mattes/filled.h"

namespace weft {
namespace {

constexpr Size kShot{400, 300};
constexpr Recti kVest{80, 40, 320, 280}, kHand{180, 120, 220, 160};

// A vest with a hand before it; both grained, so that colours have a spread.
ImageU8x3 vest_and_hand() {
    ImageU8x3 out(kShot, 0);
    for (int y = 0; y < kShot.height; ++y)
        for (int x = 0; x < kShot.width; ++x) {
            const auto grain = static_cast<std::uint8_t>((x * 7 + y * 13) % 11);
            const bool hand = kHand.contains(x, y), vest = kVest.contains(x, y);
            std::uint8_t* p = out.pixel(x, y);
            p[0] = static_cast<std::uint8_t>((hand ? 220 : vest ? 120 : 40) + grain);
            p[1] = static_cast<std::uint8_t>((hand ? 150 : vest ? 90 : 120) + grain);
            p[2] = static_cast<std::uint8_t>((hand ? 130 : vest ? 70 : 180) + grain);
        }
    return out;
}

Matte area(const Recti& of) {
    return test::filled(of, kShot);
}

Matte without(Matte from, const Recti& hole) {
    for (int y = hole.y0; y < hole.y1; ++y)
        for (int x = hole.x0; x < hole.x1; ++x)
            from.at(x, y) = 0;
    return from;
}

// Pixels of `where` that differ by more than half.
int differing(const Matte& a, const Matte& b, const Recti& where) {
    int out = 0;
    for (int y = where.y0; y < where.y1; ++y)
        for (int x = where.x0; x < where.x1; ++x)
            out += std::abs(a.at(x, y) - b.at(x, y)) > 127;
    return out;
}

constexpr Recti kAll{0, 0, kShot.width, kShot.height};

// Painted too narrow on the left, and the hand taken out by a lasso.
TEST(ScribbleChange, AddingOnOneSideLeavesAHoleElsewhere) {
    const Matte base = without(area({140, 40, 320, 280}), {160, 100, 240, 180});
    const Matte keep = area({100, 120, 106, 200}), drop = area({40, 100, 46, 200});
    const Matte out = change_by_scribbles(base, vest_and_hand(), keep, drop);
    EXPECT_GT(out.at(103, 160), 127);
    EXPECT_GT(out.at(120, 160), 127) << "as far as the surface goes";
    EXPECT_LT(out.at(60, 160), 128);
    EXPECT_EQ(differing(out, base, {142, 0, kShot.width, kShot.height}), 0);
    // what the cut alone makes of it: it fills the hole around the hand
    const Matte cut = segment_scribbles(base, vest_and_hand(), keep, drop);
    EXPECT_GT(differing(cut, base, {142, 0, kShot.width, kShot.height}), 500);
}

// The lasso ends above the vest's lower edge; taking out the hand leaves that.
TEST(ScribbleChange, TakingAwayOnOnePlaceLeavesTheRest) {
    const Matte base = area({90, 50, 310, 240});
    const Matte keep = area({190, 200, 210, 206}), drop = area({195, 130, 205, 150});
    const Matte out = change_by_scribbles(base, vest_and_hand(), keep, drop);
    EXPECT_EQ(differing(out, without(base, kHand), kAll), 0);
}

TEST(ScribbleChange, ALineOutsideActsAlone) {
    const Matte base = area(kVest), drop = area({195, 130, 205, 150});
    const Matte out = change_by_scribbles(base, vest_and_hand(), Matte(kShot), drop);
    EXPECT_LT(differing(out, without(base, kHand), kAll), 30);
    EXPECT_EQ(differing(out, base, {0, 0, 150, kShot.height}), 0);
}

// A belt that is narrower than the reach is not taken away whole.
TEST(ScribbleChange, ALineOutsideStaysNearOnAThinMatte) {
    const Matte base = area({20, 146, 380, 152}), drop = area({197, 140, 203, 158});
    const Matte out = change_by_scribbles(base, vest_and_hand(), Matte(kShot), drop);
    EXPECT_EQ(out.at(200, 149), 0);
    EXPECT_EQ(out.at(60, 149), 255);
    EXPECT_EQ(out.at(340, 149), 255);
}

// On an empty matte: what the line inside has found by the picture's edges grows by no line
// outside.
TEST(ScribbleChange, ALineOutsideAddsNothingToWhatEndsAtEdges) {
    ImageU8x3 picture = vest_and_hand();
    // A ball on the vest, and flowers of its colour along the picture's border, which say that it
    // is none of it as long as no line outside says more.
    const auto yellow = [&](const Recti& where) {
        constexpr std::uint8_t kYellow[] = {200, 170, 20};
        for (int y = where.y0; y < where.y1; ++y)
            for (int x = where.x0; x < where.x1; ++x)
                for (int k = 0; k < 3; ++k)
                    picture.pixel(x, y)[k] = static_cast<std::uint8_t>(kYellow[k] + (x + y) % 9);
    };
    yellow({250, 210, 270, 230});
    yellow({0, 0, kShot.width, 12});
    const Matte nothing(kShot), keep = area({100, 60, 300, 66});
    const Matte first = found_by_scribbles(nothing, picture, keep, nothing);
    ASSERT_TRUE(ends_at_edges(first, picture));
    ASSERT_LT(first.at(260, 220), 128);
    const Matte drop = area({10, 288, 390, 294});
    const auto added = [&](const Matte& to) {
        int out = 0;
        for (int y = 0; y < kShot.height; ++y)
            for (int x = 0; x < kShot.width; ++x)
                out += to.at(x, y) > 127 && first.at(x, y) < 128;
        return out;
    };
    const Matte out = found_by_scribbles(first, picture, keep, drop);
    EXPECT_EQ(added(out), 0);
    EXPECT_GT(added(segment_scribbles(first, picture, keep, drop)), 300) << "the cut alone";
    EXPECT_EQ(out, found_by_scribbles(nothing, picture, keep, drop)) << "however fast they come";
}

TEST(ScribbleChange, ALineOutsideAloneFindsNothing) {
    const Matte drop = area({40, 100, 46, 200});
    EXPECT_TRUE(is_empty(found_by_scribbles(Matte(kShot), vest_and_hand(), Matte(kShot), drop)));
}

}  // namespace
}  // namespace weft

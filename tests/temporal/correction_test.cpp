#include "engine/temporal/correction.h"

#include <gtest/gtest.h>

#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kSlidingFrame{320, 200};

LatticeField sliding() {
    LatticeField field(kSlidingFrame, 8);
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            const Vec2 p = field.node_position(i, j);
            field.set_node(i, j, {10 + 0.05f * p.x, -6 + 0.02f * p.y});
        }
    }
    return field;
}

Vec2 reference_of(const LatticeField& field, Vec2 p) {
    return p + field.at(p);
}

TEST(Correction, WithoutPinsNothingChanges) {
    EXPECT_EQ(corrected(sliding(), {}).nodes(), sliding().nodes());
}

TEST(Correction, OnePinMovesTheWholeTexture) {
    const LatticeField before = sliding(), after = corrected(before, {{{100, 80}, {112, 75}}});
    for (const Vec2 p : {Vec2(112, 75), Vec2(30, 40), Vec2(280, 160)})
        EXPECT_LT(distance(reference_of(after, p), reference_of(before, p - Vec2(12, -5))), 0.01f);
}

TEST(Correction, TwoPinsTurnAndScale) {
    const LatticeField before = sliding();
    // A quarter turn about (160, 100) at twice the size.
    const LatticeField after =
        corrected(before, {{{160, 100}, {160, 100}}, {{180, 100}, {160, 140}}});
    EXPECT_LT(distance(reference_of(after, {120, 100}), reference_of(before, {160, 120})), 0.01f);
}

TEST(Correction, ManyPinsAreKeptAndHoldWhatTheyHold) {
    const std::vector<SurfacePin> pins{{{60, 50}, {60, 50}},
                                       {{260, 50}, {260, 50}},
                                       {{60, 150}, {60, 150}},
                                       {{160, 100}, {168, 96}}};
    const LatticeField before = sliding(), after = corrected(before, pins);
    for (const SurfacePin& pin : pins)
        EXPECT_LT(distance(reference_of(after, pin.to), reference_of(before, pin.from)), 0.6f)
            << pin.to.x << "," << pin.to.y;
    // Near a held corner hardly anything moves.
    EXPECT_LT(distance(reference_of(after, {66, 54}), reference_of(before, {66, 54})), 0.8f);
}

TEST(Correction, MovedPinsGiveWhatTheyWouldHaveGivenAtOnce) {
    const std::vector<SurfacePin> before{{{60, 50}, {64, 48}}, {{200, 120}, {195, 124}}};
    const std::vector<SurfacePin> after{{{60, 50}, {70, 52}}, {{200, 120}, {195, 124}}};
    const LatticeField walked = sliding(), direct = corrected(walked, after);
    const LatticeField moved = recorrected(corrected(walked, before), before, after);
    for (const Vec2 p : {Vec2(70, 52), Vec2(30, 40), Vec2(280, 160)})
        EXPECT_LT(distance(reference_of(moved, p), reference_of(direct, p)), 0.05f);
    EXPECT_EQ(recorrected(direct, after, after).nodes(), direct.nodes());
    EXPECT_EQ(recorrected(walked, {}, after).nodes(), direct.nodes());
}

}  // namespace
}  // namespace weft

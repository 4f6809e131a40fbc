#include "engine/motion/lattice_root.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

namespace weft {
namespace {

constexpr Size kFull{200, 120};

LatticeField lattice_of(const std::function<Vec2(Vec2)>& place, int spacing = 8) {
    LatticeField field(kFull, spacing);
    for (int j = 0; j < field.nodes().height(); ++j)
        for (int i = 0; i < field.nodes().width(); ++i) {
            const Vec2 p = field.node_position(i, j);
            field.set_node(i, j, place(p) - p);
        }
    return field;
}

// A pan by 150 px with a bend: the reference frame shows another part of the surface.
Vec2 panned(Vec2 p) {
    return p + Vec2(150 + 4 * std::sin(0.04f * p.y), 10 + 3 * std::cos(0.05f * p.x));
}
Vec2 panned_more(Vec2 p) {
    return panned(p + Vec2(6, -2) + 2.0f * Vec2(std::cos(0.03f * p.y), std::sin(0.03f * p.x)));
}

TEST(LatticeRoot, FindsThePlaceThatGoesToATarget) {
    const LatticeField field = lattice_of(panned);
    const LatticeRoot root = root_of(field, panned({70, 50}), {60, 58});
    EXPECT_LT(glm::length(root.place - Vec2(70, 50)), 0.02f);
    EXPECT_LT(root.miss, 1e-3f);
}

TEST(LatticeRoot, IsNeverWorseThanItsStart) {
    const LatticeField field = lattice_of([](Vec2) { return Vec2(50, 50); });
    const LatticeRoot root = root_of(field, {60, 50}, {10, 10});
    EXPECT_EQ(root.place, Vec2(10, 10));
    EXPECT_NEAR(root.miss, 10, 1e-3f);
}

TEST(ThroughReference, JoinsTwoFramesThatTheReferenceFrameDoesNotShow) {
    const LatticeField there_from_here =
        through_reference(lattice_of(panned_more), lattice_of(panned));
    const auto truth = [](Vec2 p) {
        return Vec2(6, -2) + 2.0f * Vec2(std::cos(0.03f * p.y), std::sin(0.03f * p.x));
    };
    float worst = 0, by_inverse = 0;
    const LatticeField composed = compose(lattice_of(panned_more), inverse(lattice_of(panned)));
    for (int y = 4; y < 116; y += 5)
        for (int x = 4; x < 190; x += 5) {
            const Vec2 p(static_cast<float>(x), static_cast<float>(y));
            worst = std::max(worst, glm::length(there_from_here.at(p) - truth(p)));
            by_inverse = std::max(by_inverse, glm::length(composed.at(p) - truth(p)));
        }
    EXPECT_LT(worst, 0.05f);
    EXPECT_GT(by_inverse, 4 * worst) << "the plain way is no worse: it would do";
}

TEST(ThroughReference, HasTheFinerSpacing) {
    EXPECT_EQ(through_reference(lattice_of(panned, 16), lattice_of(panned, 4)).spacing(), 4);
    EXPECT_EQ(through_reference(lattice_of(panned, 4), lattice_of(panned, 16)).spacing(), 4);
}

}  // namespace
}  // namespace weft

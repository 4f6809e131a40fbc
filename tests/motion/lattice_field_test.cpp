#include "engine/motion/lattice_field.h"

#include <gtest/gtest.h>

#include "engine/core/parallel.h"
#include "tests/motion/pictures.h"

namespace weft {
namespace {

constexpr Size kOddFrame{101, 67};  // no multiple of any spacing

template <class F>
LatticeField field_of(Size full, int spacing, const F& value) {
    LatticeField out(full, spacing);
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i)
            out.set_node(i, j, value(out.node_position(i, j)));
    }
    return out;
}

Vec2 quadratic(Vec2 p) {
    return {1.5f + 0.03f * p.x - 0.02f * p.y + 0.0010f * p.x * p.x + 0.0007f * p.x * p.y,
            -0.5f - 0.01f * p.x + 0.04f * p.y - 0.0013f * p.y * p.y + 0.0004f * p.x * p.x};
}

Vec2 affine(Vec2 p) {
    return {2.0f + 0.10f * p.x - 0.05f * p.y, -1.0f + 0.02f * p.x + 0.08f * p.y};
}

Vec2 random_place(Rng& rng, float margin) {
    const auto in = [&](int extent) {
        return static_cast<float>(rng.uniform()) * (static_cast<float>(extent) + 2 * margin) -
               margin;
    };
    const float x = in(kOddFrame.width);
    return {x, in(kOddFrame.height)};
}

LatticeField random_field(int spacing) {
    Rng rng(5);
    return field_of(kOddFrame, spacing, [&](Vec2) {
        const float x = static_cast<float>(rng.uniform());
        return Vec2(10 * x - 5, 10 * static_cast<float>(rng.uniform()) - 5);
    });
}

TEST(LatticeField, InterpolatesQuadraticsExactly) {
    for (const int spacing : {1, 5, 8, 64}) {
        const LatticeField field = field_of(kOddFrame, spacing, quadratic);
        Rng rng(1);
        for (int k = 0; k < 300; ++k) {
            const Vec2 p = random_place(rng, 0);
            EXPECT_LT(distance(field.at(p), quadratic(p)), 1e-3f)
                << spacing << ": " << p.x << ", " << p.y;
        }
    }
}

TEST(LatticeField, NodesAreInterpolated) {
    const LatticeField field = random_field(8);
    for (int j = 1; j < field.nodes().height() - 1; ++j) {
        for (int i = 1; i < field.nodes().width() - 1; ++i) {
            EXPECT_LT(distance(field.at(field.node_position(i, j)), field.node(i, j)), 1e-5f);
        }
    }
}

TEST(LatticeField, DenseIsTheFieldAtPixelCentres) {
    const LatticeField field = random_field(7);
    for (const Recti area : {rect_of(kOddFrame), Recti{13, 5, 14, 66}, Recti{90, 60, 101, 67}}) {
        const ImageF2 dense = field.dense(area);
        ASSERT_EQ(dense.size(), area.size());
        for (int y = 0; y < area.height(); ++y) {
            for (int x = 0; x < area.width(); ++x) {
                const float* d = dense.pixel(x, y);
                EXPECT_LT(distance({d[0], d[1]}, field.at(centre_of(area.x0 + x, area.y0 + y))),
                          1e-4f);
            }
        }
    }
}

TEST(LatticeField, DenseDoesNotDependOnThreads) {
    const LatticeField field = random_field(8);
    set_thread_count(1);
    const ImageF2 one = field.dense(rect_of(kOddFrame));
    set_thread_count(3);
    EXPECT_EQ(field.dense(rect_of(kOddFrame)), one);
    set_thread_count(0);
}

TEST(LatticeField, GoesOnLinearlyOutside) {
    const LatticeField flat = field_of(kOddFrame, 8, affine);
    Rng rng(2);
    for (int k = 0; k < 300; ++k) {
        const Vec2 p = random_place(rng, 200);
        EXPECT_LT(distance(flat.at(p), affine(p)), 2e-3f) << p.x << ", " << p.y;
    }
    // A curved field keeps the gradient that it has at the border: no second difference, no jump.
    const LatticeField curved = field_of(kOddFrame, 8, quadratic);
    for (const Vec2 step : {Vec2(-25, 0), Vec2(25, 0), Vec2(0, -25), Vec2(0, 25)}) {
        const Vec2 a = Vec2(50, 33) + 6.0f * step;
        const Vec2 bend = curved.at(a + step) - 2.0f * curved.at(a) + curved.at(a - step);
        EXPECT_LT(std::hypot(bend.x, bend.y), 2e-3f);
    }
    for (float x = -30; x < 130; x += 0.25f) {
        EXPECT_LT(distance(curved.at({x, 20}), curved.at({x + 0.25f, 20})), 0.1f) << x;
    }
}

TEST(LatticeField, ComposesAffineMaps) {
    const auto inner = [](Vec2 p) { return Vec2(0.5f + 0.02f * p.y, -3.0f - 0.04f * p.x); };
    const LatticeField both =
        compose(field_of(kOddFrame, 8, inner), field_of(kOddFrame, 5, affine));
    EXPECT_EQ(both.spacing(), 8);
    EXPECT_EQ(both.full_size(), kOddFrame);
    Rng rng(3);
    for (int k = 0; k < 200; ++k) {
        const Vec2 p = random_place(rng, 30);
        EXPECT_LT(distance(both.at(p), inner(p) + affine(p + inner(p))), 2e-3f);
    }
}

TEST(LatticeField, ComposingWithStandstillChangesNothing) {
    const LatticeField field = random_field(8), still(kOddFrame, 8);
    EXPECT_EQ(compose(still, field).nodes().size(), field.nodes().size());
    for (int j = 1; j < field.nodes().height() - 1; ++j) {
        for (int i = 1; i < field.nodes().width() - 1; ++i) {
            EXPECT_LT(distance(compose(field, still).node(i, j), field.node(i, j)), 1e-6f);
            EXPECT_LT(distance(compose(still, field).node(i, j), field.node(i, j)), 1e-5f);
        }
    }
}

TEST(LatticeField, ResamplesWhatItCanHold) {
    const LatticeField other = field_of(kOddFrame, 8, quadratic).resampled(5);
    EXPECT_EQ(other.spacing(), 5);
    Rng rng(4);
    for (int k = 0; k < 200; ++k) {
        const Vec2 p = random_place(rng, 0);
        EXPECT_LT(distance(other.at(p), quadratic(p)), 2e-3f);
    }
}

TEST(LatticeField, MixesNodeByNode) {
    const LatticeField a = field_of(kOddFrame, 8, affine), b = field_of(kOddFrame, 8, quadratic);
    EXPECT_EQ(mix(a, b, 0).nodes(), a.nodes());
    EXPECT_LT(distance(mix(a, b, 1).node(3, 4), b.node(3, 4)), 1e-5f);
    const Vec2 quarter = 0.75f * a.node(6, 2) + 0.25f * b.node(6, 2);
    EXPECT_LT(distance(mix(a, b, 0.25f).node(6, 2), quarter), 1e-5f);
}

TEST(LatticeField, HoldsTheSmallestFrames) {
    for (const Size size : {Size{1, 1}, Size{8, 8}, Size{3, 200}}) {
        const LatticeField field = field_of(size, 8, affine);
        const ImageF2 dense = field.dense(rect_of(size));
        const float* last = dense.pixel(size.width - 1, size.height - 1);
        EXPECT_LT(distance({last[0], last[1]}, affine(centre_of(size.width - 1, size.height - 1))),
                  1e-3f);
    }
}

// A wheel turns by more than what a fixed-point iteration takes (60 degrees).
TEST(LatticeField, AnInverseOfAWholeTurnLeadsBackToo) {
    for (const float degrees : {50.0f, 75.0f, 110.0f, 180.0f, 250.0f}) {
        const float a = degrees * 3.14159265f / 180.0f, c = std::cos(a), s = std::sin(a);
        const LatticeField field = field_of({80, 60}, 8, [&](Vec2 p) {
            const Vec2 q = p - Vec2(40, 30);
            const Vec2 bent(0.8f * std::sin(p.y / 9), 0.6f * std::sin(p.x / 11));
            return Vec2(40, 30) + 1.1f * Vec2(c * q.x - s * q.y, s * q.x + c * q.y) - p + bent;
        });
        const LatticeField back = inverse(field);
        float worst = 0;
        for (int y = 14; y < 46; ++y) {
            for (int x = 24; x < 56; ++x) {
                const Vec2 p = centre_of(x, y), there = p + field.at(p);
                worst = std::max(worst, glm::length(there + back.at(there) - p));
            }
        }
        EXPECT_LT(worst, 0.2f) << degrees;
    }
}

// A torn field has slopes at which the iteration runs away to infinity.
TEST(LatticeField, AnInverseOfATornFieldIsFiniteAndNeverWorseThanStandstill) {
    Rng rng(3);
    const LatticeField field = field_of({80, 60}, 8, [&](Vec2) {
        const float x = static_cast<float>(rng.uniform());
        return 4e4f * (Vec2(x, static_cast<float>(rng.uniform())) - Vec2(0.5f));
    });
    const LatticeField back = inverse(field);
    for (int j = 0; j < back.nodes().height(); ++j) {
        for (int i = 0; i < back.nodes().width(); ++i) {
            const Vec2 target = back.node_position(i, j), p = target + back.node(i, j);
            EXPECT_LE(glm::length(p + field.at(p) - target),
                      glm::length(field.at(target)) * 1.001f + 0.1f)
                << i << "," << j;
        }
    }
}

TEST(LatticeField, AnInverseLeadsBack) {
    LatticeField field({320, 200}, 8);
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i) {
            const Vec2 p = field.node_position(i, j);
            field.set_node(i, j, {5 + 6 * std::sin(p.y / 40), -3 + 0.1f * p.x});
        }
    }
    const LatticeField round = compose(field, inverse(field));
    for (const Vec2 p : {Vec2(40, 30), Vec2(160, 100), Vec2(290, 150)})
        EXPECT_LT(glm::length(round.at(p)), 0.05f) << p.x << "," << p.y;
}

TEST(LatticeField, IsTheSameMotionUnsqueezed) {
    const LatticeField field = field_of(kOddFrame, 8, affine);
    const PixelAspect aspect(2);
    const LatticeField wide = unsqueezed(field, aspect);
    EXPECT_EQ(wide.full_size(), (Size{202, 67}));
    EXPECT_EQ(wide.spacing(), 8);
    for (const Vec2 p : {Vec2(3, 4), Vec2(50.5f, 33), Vec2(99, 60), Vec2(-20, 90)})
        EXPECT_LT(distance(wide.at(aspect.unsqueezed(p)), aspect.unsqueezed(affine(p))), 1e-3f);
    const LatticeField bent = field_of(kOddFrame, 8, quadratic);
    const Vec2 p(40, 30);
    EXPECT_LT(
        distance(unsqueezed(bent, aspect).at(aspect.unsqueezed(p)), aspect.unsqueezed(bent.at(p))),
        1e-2f);
    EXPECT_EQ(unsqueezed(bent, {}).nodes(), bent.nodes());
}

}  // namespace
}  // namespace weft

#include "engine/metrics/motion_chain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/metrics/synthetic.h"

namespace weft {
namespace {

using synthetic::constant_motion;
using synthetic::rectangle;

constexpr Size kTurningSize{100, 80};

// p → c + R(angle) (p − c), as a displacement on the source's pixels.
FlowField turning(double degrees) {
    FlowField f(kTurningSize);
    const double a = degrees * synthetic::kPi / 180;
    for (int y = 0; y < kTurningSize.height; ++y) {
        for (int x = 0; x < kTurningSize.width; ++x) {
            const double px = x + 0.5 - 50;
            const double py = y + 0.5 - 40;
            f.d.at(x, y, 0) = static_cast<float>(std::cos(a) * px - std::sin(a) * py - px);
            f.d.at(x, y, 1) = static_cast<float>(std::sin(a) * px + std::cos(a) * py - py);
        }
    }
    return f;
}

// The largest distance between a field and a rotation where it is valid within 30 px of the centre.
double worst_miss(const FlowField& f, double degrees, int& seen) {
    const FlowField truth = turning(degrees);
    double worst = 0;
    seen = 0;
    for (int y = 0; y < kTurningSize.height; ++y) {
        for (int x = 0; x < kTurningSize.width; ++x) {
            if (f.valid.at(x, y) == 0 || std::hypot(x + 0.5 - 50, y + 0.5 - 40) > 30) continue;
            ++seen;
            worst = std::max(
                worst, std::hypot(static_cast<double>(f.d.at(x, y, 0) - truth.d.at(x, y, 0)),
                                  static_cast<double>(f.d.at(x, y, 1) - truth.d.at(x, y, 1))));
        }
    }
    return worst;
}

TEST(MotionChain, ComposesATurnBothWaysWithoutLosingIt) {
    const Matte all(kTurningSize, 255);
    MotionChain forward(all);
    MotionChain inverse(all);
    for (int i = 0; i < 10; ++i) {
        forward.advance(turning(3), all);
        inverse.advance_inverse(turning(-3), all);
    }
    int seen = 0;
    EXPECT_LT(worst_miss(forward.cur_from_ref(), 30, seen), 0.01);
    EXPECT_GT(seen, 2800);
    EXPECT_LT(worst_miss(forward.ref_from_cur(), -30, seen), 0.01);
    EXPECT_GT(seen, 2800);
    EXPECT_LT(worst_miss(inverse.cur_from_ref(), 30, seen), 0.02);
    EXPECT_GT(seen, 2800);
}

TEST(MotionChain, DoesNotMixInTheMotionBeyondTheEdge) {
    // A square goes right by 1.5 px a frame over a background that rushes left.
    FlowField f;
    Matte matte = rectangle(kTurningSize, {20, 20, 60, 60});
    MotionChain chain(matte);
    for (int i = 0; i < 8; ++i) {
        f = constant_motion(kTurningSize, -20, 3);
        for (int y = 0; y < kTurningSize.height; ++y) {
            for (int x = 0; x < kTurningSize.width; ++x) {
                if (matte.at(x, y) == 0) continue;
                f.d.at(x, y, 0) = 1.5f;
                f.d.at(x, y, 1) = 0;
            }
        }
        const int x0 = 20 + static_cast<int>(1.5 * (i + 1));
        matte = rectangle(kTurningSize, {x0, 20, x0 + 40, 60});
        chain.advance(f, matte);
    }
    int alive = 0;
    for (int y = 0; y < kTurningSize.height; ++y) {
        for (int x = 0; x < kTurningSize.width; ++x) {
            if (chain.cur_from_ref().valid.at(x, y) == 0) continue;
            ++alive;
            EXPECT_NEAR(chain.cur_from_ref().d.at(x, y, 0), 12.0f, 1e-4f);
            EXPECT_NEAR(chain.cur_from_ref().d.at(x, y, 1), 0.0f, 1e-4f);
        }
    }
    EXPECT_GT(alive, 34 * 34);
}

TEST(MotionChain, BreaksForGoodWhereAHoldoutPasses) {
    const FlowField none(kTurningSize);
    const Matte all(kTurningSize, 255);
    Matte covered = all;
    for (int y = 0; y < kTurningSize.height; ++y) {
        for (int x = 40; x < 50; ++x)
            covered.at(x, y) = 0;
    }
    MotionChain chain(all);
    chain.advance(none, covered);
    chain.advance(none, all);
    EXPECT_EQ(chain.cur_from_ref().valid.at(45, 40), 0);
    EXPECT_EQ(chain.cur_from_ref().valid.at(38, 40), 0);  // Within the margin of 2 px.
    EXPECT_EQ(chain.cur_from_ref().valid.at(37, 40), 255);
    EXPECT_EQ(chain.ref_from_cur().valid.at(45, 40), 0);
    EXPECT_EQ(chain.ref_from_cur().valid.at(30, 40), 255);
}

TEST(Landing, GivesUpBothSheetsOfAFold) {
    // The right part slides 10 px over the left part, which stands still.
    FlowField f(kTurningSize);
    for (int y = 0; y < kTurningSize.height; ++y) {
        for (int x = 50; x < kTurningSize.width; ++x)
            f.d.at(x, y, 0) = -10;
    }
    const Matte single = landing_is_single(f, Matte(kTurningSize, 255));
    EXPECT_EQ(single.at(30, 40), 255);
    EXPECT_EQ(single.at(45, 40), 0);
    EXPECT_EQ(single.at(55, 40), 0);
    EXPECT_EQ(single.at(70, 40), 255);
    // A plain shrink by a tenth piles pixels up without any fold.
    FlowField shrink(kTurningSize);
    for (int y = 0; y < kTurningSize.height; ++y) {
        for (int x = 0; x < kTurningSize.width; ++x)
            shrink.d.at(x, y, 0) = -0.1f * static_cast<float>(x);
    }
    EXPECT_EQ(landing_is_single(shrink, Matte(kTurningSize, 255)).at(90, 40), 255);
}

}  // namespace
}  // namespace weft

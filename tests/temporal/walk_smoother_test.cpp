// Registrations that jitter along steps that drift.
#include "engine/temporal/walk_smoother.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "engine/core/rng.h"

namespace weft {
namespace {

constexpr Size kFrame{160, 96};
constexpr int kSpacing = 8, kFrames = 40;

LatticeField shifted(Vec2 by) {
    LatticeField field(kFrame, kSpacing);
    for (int j = 0; j < field.nodes().height(); ++j) {
        for (int i = 0; i < field.nodes().width(); ++i)
            field.set_node(i, j, by);
    }
    return field;
}

// A surface that moves on a curve, seen with an error of its own on every frame.
struct Walk {
    float noise_px = 0.2f, bias_px = 0.15f;  // of a registration; of a step

    [[nodiscard]] static Vec2 place(int t) {
        const auto x = static_cast<float>(t);
        return {1.5f * x, 4 * std::sin(0.2f * x)};
    }
    [[nodiscard]] LatticeField registered(int t) const {
        Rng rng(5, 0, static_cast<std::uint64_t>(t));
        const Vec2 error(static_cast<float>(rng.uniform() - 0.5),
                         static_cast<float>(rng.uniform() - 0.5));
        return shifted(-place(t) + 2 * noise_px * error);
    }
    [[nodiscard]] LatticeField step(int t) const {
        return shifted(place(t - 1) - place(t) + Vec2(bias_px, 0));
    }
};

float error_of(const LatticeField& field, int t) {
    return glm::length(field.at({80, 48}) + Walk::place(t));
}

// The final positions by frame.
class Smoothed {
  public:
    explicit Smoothed(const Walk& walk) : walk_(walk) { smoother.begin(shifted(Vec2(0))); }
    void add(int t) {
        smoother.add(walk_.registered(t), walk_.step(t));
        take(t);
    }
    void take(int now) {
        for (const Settled& s : smoother.take())
            EXPECT_TRUE(of.emplace(now - s.frames_back, s.ref_from_frame).second) << "only once";
    }

    WalkSmoother smoother;
    std::map<int, LatticeField> of;

  private:
    Walk walk_;
};

TEST(WalkSmoother, TakesJitterOutAndNoDriftIn) {
    const Walk walk;
    Smoothed smoothed(walk);
    for (int t = 1; t < kFrames; ++t)
        smoothed.add(t);
    smoothed.smoother.finish();
    smoothed.take(kFrames - 1);
    ASSERT_EQ(smoothed.of.size(), static_cast<std::size_t>(kFrames - 1)) << "all but the first";
    double before = 0, after = 0;
    for (int t = 5; t < kFrames - 4; ++t) {
        before += std::pow(error_of(walk.registered(t), t), 2);
        after += std::pow(error_of(smoothed.of.at(t), t), 2);
    }
    EXPECT_LT(after, 0.45 * before);
}

TEST(WalkSmoother, LeavesExactRegistrationsWhereTheyAre) {
    const Walk exact{0, 0.3f};
    Smoothed smoothed(exact);
    for (int t = 1; t < kFrames; ++t)
        smoothed.add(t);
    smoothed.smoother.finish();
    smoothed.take(kFrames - 1);
    for (const auto& [t, field] : smoothed.of)
        EXPECT_LT(error_of(field, t), 2e-3f) << t << ": a bias of the steps is a slope";
}

TEST(WalkSmoother, NothingIsSaidAcrossAFrameThatWasNotRegistered) {
    const Walk walk;
    Smoothed smoothed(walk), other(walk);
    for (int t = 1; t < 10; ++t) {
        smoothed.add(t);
        if (t < 6) other.add(t);
    }
    for (auto* s : {&smoothed, &other}) {
        const int last = s == &smoothed ? 10 : 6;
        s->smoother.skip();
        s->take(last);
        EXPECT_EQ(s->of.count(last), 0u);
    }
    EXPECT_EQ(smoothed.of.size(), 9u);
    EXPECT_EQ(other.of.size(), 5u);
    // One frame by itself stays as it was registered.
    smoothed.add(11);
    smoothed.smoother.skip();
    smoothed.take(12);
    EXPECT_EQ(smoothed.of.at(11).nodes(), walk.registered(11).nodes());
}

TEST(WalkSmoother, HeldAndPlacedFramesStay) {
    Smoothed held{Walk()};
    for (int t = 1; t < 6; ++t)
        held.add(t);
    held.smoother.hold();
    held.take(6);
    EXPECT_EQ(held.of.count(4), 1u);
    EXPECT_EQ(held.of.count(5), 0u) << "the frame that is held";

    Smoothed placed{Walk()};
    for (int t = 1; t < 6; ++t)
        placed.add(t);
    placed.smoother.place(shifted(Vec2(9)));
    placed.take(5);
    EXPECT_EQ(placed.of.count(4), 1u);
    EXPECT_EQ(placed.of.count(5), 0u) << "the frame that was placed";
    EXPECT_LT(error_of(placed.of.at(4), 4), 0.5f) << "those before do not follow";
}

}  // namespace
}  // namespace weft

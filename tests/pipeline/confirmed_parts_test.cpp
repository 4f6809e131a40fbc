// What is confirmed on a frame corrects the frames around it, there and nowhere else.
#include <gtest/gtest.h>

#include <cstdlib>

#include "engine/pipeline/matte_pass.h"
#include "engine/pipeline/matte_stretch.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

constexpr int kMiddle = 80;                // of the wall that was painted
constexpr Recti kNarrow{20, 16, 110, 96};  // as it was painted: its right edge is missing
constexpr Recti kRightHalf{kMiddle, 0, 160, 112};

class Confirmed : public MemoryShot {
  public:
    Confirmed() : MemoryShot(make_wall()) {}
    std::map<int, ConfirmedPart> parts;
    [[nodiscard]] Expected<ConfirmedPart> confirmed_part(int region, int layer,
                                                         int frame) const override {
        EXPECT_EQ(region, 0);
        EXPECT_EQ(layer, 0);
        return parts.at(frame);
    }
};

Matte moved_box(const Recti& box, int frame, int key) {
    const Vec2 by = wall_moved({0, 0}, frame) - wall_moved({0, 0}, key);
    const auto dx = static_cast<int>(std::lround(by.x)), dy = static_cast<int>(std::lround(by.y));
    return box_matte(Recti{box.x0 + dx, box.y0 + dy, box.x1 + dx, box.y1 + dy});
}

class ConfirmedParts : public testing::Test {
  protected:
    // Painted too narrow on the keys; on `frame` the right half is confirmed as it should be.
    void make(std::vector<int> keys, int frame) {
        plan_ = make_plan(make_region(flat_texture({1, 0, 0})));
        RegionPlan& region = plan_.regions[0];
        region.matte_keys = keys;
        region.reference_frames = {keys.front()};
        for (const int key : keys)
            shot_.keys[{0, key}] = moved_box(kNarrow, key, 1);
        shot_.parts[frame] = {moved_box(kRegionBox, frame, 1), box_matte(kRightHalf)};
    }
    [[nodiscard]] std::map<int, Matte> propagated(std::vector<int> confirmed) {
        plan_.regions[0].matte_confirmed = std::move(confirmed);
        MemoryAnalysisStore store;
        const Status done =
            propagate_mattes({shot_, plan_, {}, [](int, double) {}, nullptr}, store);
        EXPECT_TRUE(done) << (done ? "" : done.error().text());
        EXPECT_EQ(count_matte_steps(plan_, store), 0);
        std::map<int, Matte> out;
        for (int frame = kFirst; frame <= kLast; ++frame)
            if (const auto bytes = store.get({0, frame, AnalysisKind::kMatte}))
                out[frame] = decode_matte(*bytes)->matte;
        return out;
    }
    // Pixels by which the right edge lies beyond that of the narrow box, in the middle row.
    [[nodiscard]] static int beyond(const Matte& matte, int frame) {
        const Matte narrow = moved_box(kNarrow, frame, 1);
        int out = 0;
        for (int x = kMiddle; x < matte.width(); ++x)
            out += (matte.at(x, 56) > 127) - (narrow.at(x, 56) > 127);
        return out;
    }
    // Away from what is confirmed its edge, which no picture marks here, keeps its place to a tenth
    // of a pixel in the mean and to half a pixel everywhere: what a walk knows of the whole, such
    // as the noise of the background, differs a little.
    static void expect_same_left(const Matte& a, const Matte& b, int frame) {
        double sum = 0;
        int edge = 0;
        for (int y = 0; y < a.height(); ++y) {
            for (int x = 0; x < kMiddle - 20; ++x) {
                const int is = a.at(x, y), was = b.at(x, y);
                ASSERT_NEAR(is, was, 127) << x << ", " << y << " on frame " << frame;
                if (is == was && (is == 0 || is == 255)) continue;
                sum += std::abs(is - was);
                ++edge;
            }
        }
        ASSERT_GT(edge, 0) << frame;
        EXPECT_LT(sum / edge, 25) << frame;
    }
    void expect_as_confirmed(const Matte& matte, int frame) const {
        EXPECT_EQ(matte, with_confirmed(matte, shot_.parts.at(frame))) << frame;
    }

    Confirmed shot_;
    ShotPlan plan_;
};

constexpr int kMissing = kRegionBox.x1 - kNarrow.x1;

TEST_F(ConfirmedParts, CorrectBothDirectionsFromTheirFrame) {
    make({1}, 6);
    const auto before = propagated({}), after = propagated({6});
    EXPECT_EQ(after.at(1), (shot_.keys[{0, 1}])) << "keyframes stay as painted";
    expect_as_confirmed(after.at(6), 6);
    for (const int frame : {5, 7, 8, 9, 10}) {
        EXPECT_LT(beyond(before.at(frame), frame), kMissing / 3) << frame;
        EXPECT_GT(beyond(after.at(frame), frame), kMissing - 4) << frame;
    }
    for (int frame = 2; frame <= 10; ++frame)
        expect_same_left(before.at(frame), after.at(frame), frame);
}

TEST_F(ConfirmedParts, CorrectWhatLiesBeforeTheFirstKeyframe) {
    make({8}, 4);
    const auto before = propagated({}), after = propagated({4});
    EXPECT_EQ(after.at(8), (shot_.keys[{0, 8}]));
    expect_as_confirmed(after.at(4), 4);
    expect_same_left(before.at(4), after.at(4), 4);
    for (const int frame : {1, 2, 3, 5}) {
        EXPECT_LT(beyond(before.at(frame), frame), kMissing / 3) << frame;
        EXPECT_GT(beyond(after.at(frame), frame), kMissing - 4) << frame;
        expect_same_left(before.at(frame), after.at(frame), frame);
    }
    for (const int frame : {9, 10})
        EXPECT_EQ(before.at(frame), after.at(frame)) << "another stretch";
}

TEST_F(ConfirmedParts, CountBetweenTwoKeyframesAsKeyframesOfTheirArea) {
    make({1, 10}, 5);
    const auto before = propagated({}), after = propagated({5});
    expect_as_confirmed(after.at(5), 5);
    EXPECT_GT(beyond(after.at(4), 4), kMissing / 2);
    EXPECT_GT(beyond(after.at(6), 6), kMissing / 2);
    for (int frame = 2; frame <= 9; ++frame)
        expect_same_left(before.at(frame), after.at(frame), frame);
}

TEST_F(ConfirmedParts, AreFollowedInTheDirectionOfTheMatteOnly) {
    make({1}, 6);
    plan_.regions[0].matte_reach.direction = PropagationDirection::kForward;
    const auto before = propagated({}), after = propagated({6});
    for (int frame = 1; frame < 6; ++frame)
        EXPECT_EQ(before.at(frame), after.at(frame)) << frame;
    EXPECT_GT(beyond(after.at(9), 9), kMissing - 4);
}

TEST(MatteStretches, BeginWithConfirmedFramesWhereThereIsNoKeyframe) {
    PaintedMatte painted{{5}, 0.5f, {}};
    painted.confirmed = {2, 5, 7, 9, 20};
    const auto parts = stretches(0, 0, painted, {1, 10});
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(parts[0].confirmed, std::vector<int>{2});
    EXPECT_EQ(parts[0].forward().first, 2);
    EXPECT_EQ(parts[0].forward().last, 4);
    EXPECT_EQ(parts[0].backward().last, 5);
    EXPECT_FALSE(parts[0].merged(1));
    EXPECT_TRUE(parts[0].merged(3));
    EXPECT_EQ(parts[0].key_before(), std::nullopt);
    EXPECT_EQ(parts[0].key_after(), 5);
    EXPECT_EQ(parts[1].confirmed, (std::vector<int>{7, 9})) << "not the keyframe, nor beyond";
    EXPECT_EQ(parts[1].backward().first, 6);
    EXPECT_EQ(parts[1].backward().last, 9);
    EXPECT_TRUE(parts[1].merged(9));
    EXPECT_FALSE(parts[1].merged(10));
}

}  // namespace
}  // namespace weft

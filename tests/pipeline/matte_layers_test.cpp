// Painted holdouts, and propagation in one direction or within a range.
#include <gtest/gtest.h>

#include <limits>

#include "engine/compute/backend_registry.h"
#include "engine/pipeline/matte_pass.h"
#include "engine/pipeline/render_frame.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

// The wall with a disc in front whose matte is painted on some frames only.
class PaintedDisc : public MemoryShot {
  public:
    PaintedDisc() : MemoryShot(make_wall(true)) { holdouts.clear(); }
    [[nodiscard]] Expected<Matte> holdout_key(int, int painted, int frame) const override {
        EXPECT_EQ(painted, 0);
        return disc_matte(frame);
    }
};

RegionPlan painted_region(std::vector<int> keys) {
    RegionPlan region = make_region(flat_texture({1, 0, 0}));
    region.painted_holdouts.push_back({std::move(keys), 0.5f, {}});
    return region;
}

Matte stored_matte(const AnalysisStore& store, int frame, int layer) {
    const auto bytes = store.get({0, frame, AnalysisKind::kMatte, layer});
    if (!bytes) return {};
    return decode_matte(*bytes)->matte;
}

bool any(const Matte& matte) {
    return std::any_of(matte.data(), matte.data() + matte.size_bytes(),
                       [](std::uint8_t v) { return v > 0; });
}

TEST(PaintedHoldouts, ArePropagatedAndCutOut) {
    const PaintedDisc shot;
    const ShotPlan plan = make_plan(painted_region({4, 5, 6}));
    MemoryAnalysisStore store;
    expect_ok(analyse_shot(shot, plan, store, {}, {}));
    EXPECT_EQ(stored_matte(store, 5, 1), disc_matte(5)) << "as painted";
    auto scene = make_scene(shot, plan, store, 0, {}, {});
    ASSERT_TRUE(scene) << scene.error().text();
    const std::vector<RegionScene> scenes{std::move(*scene)};
    const auto frame = render_frame(shot, plan, scenes, store, *make_cpu_backend(), 5);
    ASSERT_TRUE(frame) << frame.error().text();
    const auto plate = shot.plate(5);
    // The disc's middle is the plate's, the wall beside it has the new colour.
    EXPECT_NEAR(frame->pixels.pixel(80, 56)[0], (*plate)->pixel(80, 56)[0], 2e-2f);
    EXPECT_GT(frame->pixels.pixel(40, 56)[0], 0.9f);
}

TEST(PaintedHoldouts, HaveAKeyOfTheirOwnInTheStore) {
    const PaintedDisc shot;
    RegionPlan region = painted_region({5});
    const ShotPlan plan = make_plan(region);
    MemoryAnalysisStore store;
    EXPECT_GT(count_matte_steps(plan, store), 0);
    expect_ok(propagate_mattes({shot, plan, {}, [](int, double) {}}, store));
    EXPECT_EQ(count_matte_steps(plan, store), 0);
    for (int frame = kFirst; frame <= kLast; ++frame) {
        EXPECT_TRUE(store.has({0, frame, AnalysisKind::kMatte, 1})) << frame;
        EXPECT_FALSE(store.has({0, frame, AnalysisKind::kMatte})) << frame;
    }
}

Status propagate(const ShotSource& shot, const ShotPlan& plan, AnalysisStore& store) {
    return propagate_mattes({shot, plan, {}, [](int, double) {}, nullptr}, store);
}

class Stretches : public testing::Test {
  protected:
    Stretches() {
        for (const int key : {2, 5, 8})
            shot_.keys[{0, key}] = box_matte(kRegionBox);
        RegionPlan region = make_region(flat_texture({1, 0, 0}));
        region.matte_keys = {2, 5, 8};
        region.reference_frames = {2};
        plan_ = make_plan(region);
    }

    MemoryShot shot_ = make_wall();
    ShotPlan plan_;
};

TEST_F(Stretches, AStrokeLeavesWhatLiesBeyondItsNeighboursAsItIs) {
    MemoryAnalysisStore before, after, anew;
    expect_ok(propagate(shot_, plan_, before));
    shot_.keys[{0, 8}] = box_matte({20, 16, 90, 96});
    expect_ok(propagate(shot_, plan_, anew));
    for (int frame = kFirst; frame < 5; ++frame)
        expect_ok(after.put({0, frame, AnalysisKind::kMatte},
                            *before.get({0, frame, AnalysisKind::kMatte})));
    EXPECT_EQ(count_matte_steps(plan_, after), 6 + 4 + 2)
        << "forwards from 5 to 10, back from 8 to 5, and what is merged on 6 and 7";
    expect_ok(propagate(shot_, plan_, after));
    for (int frame = kFirst; frame <= kLast; ++frame)
        EXPECT_EQ(stored_matte(after, frame, 0), stored_matte(anew, frame, 0)) << frame;
    EXPECT_NE(stored_matte(anew, 7, 0), stored_matte(before, 7, 0));
}

TEST_F(Stretches, ThatOfOneFrameCanBeMadeAlone) {
    MemoryAnalysisStore one, all;
    expect_ok(propagate_mattes_at({shot_, plan_, {}, [](int, double) {}, nullptr}, one, 6));
    expect_ok(propagate(shot_, plan_, all));
    for (int frame = kFirst; frame <= kLast; ++frame) {
        ASSERT_EQ(one.has({0, frame, AnalysisKind::kMatte}), frame >= 5 && frame < 8) << frame;
        if (frame >= 5 && frame < 8) {
            EXPECT_EQ(stored_matte(one, frame, 0), stored_matte(all, frame, 0)) << frame;
        }
    }
}

TEST_F(Stretches, KeyframesBesideEachOtherAreKeptAsPainted) {
    shot_.keys[{0, 3}] = box_matte({30, 20, 80, 60});
    plan_.regions[0].matte_keys = {2, 3, 5, 8};
    MemoryAnalysisStore store;
    expect_ok(propagate(shot_, plan_, store));
    for (const int key : plan_.regions[0].matte_keys)
        EXPECT_EQ(stored_matte(store, key, 0), (shot_.keys[{0, key}])) << key;
    for (int frame = kFirst; frame <= kLast; ++frame)
        EXPECT_TRUE(any(stored_matte(store, frame, 0))) << frame;
}

// The wall and the disc in front of it, both painted on some frames only.
struct BothPainted : PaintedDisc {
    explicit BothPainted(const std::vector<int>& matte_keys) {
        for (const int key : matte_keys)
            keys[{0, key}] = box_matte(kRegionBox);
    }
};

ShotPlan both_painted(std::vector<int> matte_keys, std::vector<int> holdout_keys) {
    RegionPlan region = painted_region(std::move(holdout_keys));
    region.reference_frames = {matte_keys.front()};
    region.matte_keys = std::move(matte_keys);
    return make_plan(region);
}

TEST(PaintedHoldouts, HideTheMatteBehindInWhateverOrderBothAreMade) {
    struct Keys {
        std::vector<int> matte, holdout;
        int steps;
    };
    const std::vector<Keys> all{{{5}, {3}, 8 + 5},          // one walk there, one back
                                {{5}, {8}, 3 + 8 + 6 + 5},  // the holdout's first
                                {{2, 9}, {2, 6}, 9 + 6 + 3 + 9 + 9 + 6}};  // and merged
    for (const auto& [matte, holdout, steps] : all) {
        const BothPainted shot(matte);
        const ShotPlan plan = both_painted(matte, holdout);
        MemoryAnalysisStore at_once, apart, by_frame;
        EXPECT_EQ(count_matte_steps(plan, at_once), steps);
        int taken = 0;
        expect_ok(propagate_mattes({shot, plan, {}, [&](int, double) { ++taken; }}, at_once));
        EXPECT_EQ(taken, steps);
        // Holdouts that were made before.
        for (int frame = kFirst; frame <= kLast; ++frame) {
            const AnalysisKey front{0, frame, AnalysisKind::kMatte, 1};
            expect_ok(apart.put(front, *at_once.get(front)));
        }
        expect_ok(propagate(shot, plan, apart));
        for (const int frame : {7, 2, 10}) {
            expect_ok(propagate_mattes_at({shot, plan, {}, [](int, double) {}, nullptr}, by_frame,
                                          frame));
        }
        expect_ok(propagate(shot, plan, by_frame));
        for (int frame = kFirst; frame <= kLast; ++frame) {
            EXPECT_EQ(stored_matte(apart, frame, 0), stored_matte(at_once, frame, 0)) << frame;
            EXPECT_EQ(stored_matte(by_frame, frame, 0), stored_matte(at_once, frame, 0)) << frame;
            EXPECT_EQ(stored_matte(by_frame, frame, 1), stored_matte(at_once, frame, 1)) << frame;
        }
    }
}

struct Way {
    PropagationDirection direction;
    int first, last;
    std::vector<int> filled;
};

TEST(MatteReach, BeyondItThereIsNoMatte) {
    MemoryShot shot = make_wall();
    for (const int key : {4, 7})
        shot.keys[{0, key}] = box_matte(kRegionBox);
    const int none = std::numeric_limits<int>::min(), all = std::numeric_limits<int>::max();
    const std::vector<Way> ways{
        {PropagationDirection::kForward, none, all, {4, 5, 6, 7, 8, 9, 10}},
        {PropagationDirection::kBackward, none, all, {1, 2, 3, 4, 5, 6, 7}},
        {PropagationDirection::kBoth, 3, 5, {3, 4, 5, 7}},
        {PropagationDirection::kForward, 8, 9, {4, 7, 8, 9}},
    };
    for (const Way& way : ways) {
        RegionPlan region = make_region(flat_texture({1, 0, 0}));
        region.reference_frames = {4};
        region.matte_keys = {4, 7};
        region.matte_reach = {way.direction, way.first, way.last};
        const ShotPlan plan = make_plan(region);
        MemoryAnalysisStore store;
        expect_ok(propagate_mattes({shot, plan, {}, [](int, double) {}}, store));
        EXPECT_EQ(count_matte_steps(plan, store), 0);
        std::vector<int> filled;
        for (int frame = kFirst; frame <= kLast; ++frame) {
            ASSERT_TRUE(store.has({0, frame, AnalysisKind::kMatte})) << frame;
            if (any(stored_matte(store, frame, 0))) filled.push_back(frame);
        }
        EXPECT_EQ(filled, way.filled) << static_cast<int>(way.direction);
    }
}

TEST(MatteReach, OneWayTheMatteComesFromOneSideOnly) {
    // The keyframe of frame 8 is not used: forwards, frame 7 does not depend on it.
    MemoryShot shot = make_wall();
    shot.keys[{0, 3}] = box_matte({20, 16, 60, 96});
    shot.keys[{0, 8}] = box_matte({100, 16, 150, 96});
    const auto matte_of_7 = [&](PropagationDirection direction) {
        RegionPlan region = make_region(flat_texture({1, 0, 0}));
        region.matte_keys = {3, 8};
        region.matte_reach.direction = direction;
        MemoryAnalysisStore store;
        const ShotPlan plan = make_plan(region);
        expect_ok(propagate_mattes({shot, plan, {}, [](int, double) {}}, store));
        return stored_matte(store, 7, 0);
    };
    const Matte forward = matte_of_7(PropagationDirection::kForward);
    const Matte backward = matte_of_7(PropagationDirection::kBackward);
    EXPECT_GT(forward.at(45, 50), 200);
    EXPECT_LT(forward.at(125, 50), 50);
    EXPECT_LT(backward.at(45, 50), 50);
    EXPECT_GT(backward.at(125, 50), 200);
}

}  // namespace
}  // namespace weft

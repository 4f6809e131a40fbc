// A matte ends where another scene begins.
#include <gtest/gtest.h>

#include "engine/pipeline/matte_pass.h"
#include "engine/pipeline/plate_views.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

constexpr int kCut = 6;

// The wall; from kCut on, where `other` holds, boards of another scene.
MemoryShot shot_with(bool (*other)(int frame)) {
    MemoryShot shot = make_wall();
    for (int frame = kFirst; frame <= kLast; ++frame) {
        if (!other(frame)) continue;
        auto plate = std::make_shared<ImageF3>(kShotSize);
        for (int y = 0; y < kShotSize.height; ++y) {
            for (int x = 0; x < kShotSize.width; ++x)
                for (int c = 0; c < 3; ++c)
                    plate->at(x, y, c) = (x / 10 + y / 10) % 2 ? 0.95f : 0.05f;
        }
        shot.plates[frame] = plate;
    }
    return shot;
}

std::map<int, StoredMatte> propagated(MemoryShot shot, const std::vector<int>& keys) {
    ShotPlan plan = make_plan(make_region(flat_texture({1, 0, 0})));
    RegionPlan& region = plan.regions[0];
    region.matte_keys = keys;
    region.reference_frames = {keys.front()};
    for (const int key : keys)
        shot.keys[{0, key}] = box_matte(kRegionBox);
    MemoryAnalysisStore store;
    EXPECT_TRUE(propagate_mattes({shot, plan, {}, [](int, double) {}, nullptr}, store));
    std::map<int, StoredMatte> out;
    for (int frame = kFirst; frame <= kLast; ++frame)
        out[frame] = *decode_matte(*store.get({0, frame, AnalysisKind::kMatte}));
    return out;
}

bool shows(const StoredMatte& matte) {
    return !matte_bounds(matte.matte).empty() && matte.confidence > 0.5f;
}

TEST(MatteCut, EndsThereEmptyAndWithoutConfidence) {
    const auto mattes = propagated(shot_with([](int frame) { return frame >= kCut; }), {kFirst});
    for (const auto& [frame, matte] : mattes) {
        EXPECT_EQ(shows(matte), frame < kCut) << frame;
        if (frame < kCut) continue;
        EXPECT_EQ(matte.confidence, 0) << frame;
        EXPECT_TRUE(matte_bounds(matte.matte).empty()) << frame;
    }
}

TEST(MatteCut, EachSceneFollowsItsOwnKeyframe) {
    const auto mattes =
        propagated(shot_with([](int frame) { return frame >= kCut; }), {kFirst, kLast});
    for (const auto& [frame, matte] : mattes)
        EXPECT_TRUE(shows(matte)) << frame;
}

TEST(MatteCut, AFlashIsNone) {
    const auto mattes = propagated(shot_with([](int frame) { return frame == kCut; }), {kFirst});
    for (const auto& [frame, matte] : mattes)
        EXPECT_TRUE(shows(matte)) << frame;
}

// The same wall with other paint: neither composition nor histogram tells it from the first.
MemoryShot wall_that_becomes(float (*share)(int frame)) {
    MemoryShot shot = make_wall();
    const WaveTexture other(57);
    for (int frame = kFirst; frame <= kLast; ++frame) {
        auto plate = std::make_shared<ImageF3>(*shot.plates[frame]);
        const float b = share(frame);
        for (int y = 0; y < kShotSize.height; ++y) {
            for (int x = 0; x < kShotSize.width; ++x) {
                const float there = other(centre_of(x, y));
                for (int c = 0; c < 3; ++c)
                    plate->at(x, y, c) = plate->at(x, y, c) * (1 - b) + b * there;
            }
        }
        shot.plates[frame] = plate;
    }
    return shot;
}

TEST(MatteCut, BetweenScenesThatLookAlikeConfidenceEnds) {
    const auto mattes = propagated(
        wall_that_becomes([](int frame) { return frame < kCut ? 0.0f : 1.0f; }), {kFirst});
    for (const auto& [frame, matte] : mattes)
        EXPECT_EQ(matte.confidence > 0.3f, frame < kCut) << frame << ": " << matte.confidence;
    EXPECT_EQ(mattes.at(kLast).confidence, 0);
}

TEST(MatteCut, InADissolveConfidenceEndsAndTheOtherKeyframesMatteTakesOver) {
    const auto dissolve = [](int frame) {
        return std::clamp(static_cast<float>(frame - 3) / 5.0f, 0.0f, 1.0f);
    };
    const auto mattes = propagated(wall_that_becomes(dissolve), {kFirst});
    EXPECT_GT(mattes.at(3).confidence, 0.3f);
    EXPECT_EQ(mattes.at(kLast).confidence, 0);
    EXPECT_GT(propagated(wall_that_becomes(dissolve), {kFirst, kLast}).at(9).confidence, 0.3f);
}

}  // namespace
}  // namespace weft

// On which frames focus is read, and what the others take from it.
#include "engine/pipeline/focus_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "engine/pipeline/focus_frames.h"
#include "engine/pipeline/region_mattes.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

constexpr int kEnd = 21;

// Stripes of two greys, 12 px wide, as blurred as `blur_px` says for each frame.
MemoryShot striped_wall(const std::function<float(int)>& blur_px) {
    MemoryShot shot(kShotSize);
    for (int frame = 1; frame <= kEnd; ++frame) {
        auto plate = std::make_shared<ImageF3>(kShotSize);
        const float blur = blur_px(frame);
        for (int y = 0; y < kShotSize.height; ++y) {
            for (int x = 0; x < kShotSize.width; ++x) {
                const float edge = std::round(static_cast<float>(x) / 12);
                const float away = static_cast<float>(x) + 0.5f - 12 * edge;
                const float sign = static_cast<int>(edge) % 2 == 0 ? 1.0f : -1.0f;
                const float v = 0.5f + 0.2f * sign * std::erf(away / (blur * std::sqrt(2.0f)));
                std::fill_n(plate->pixel(x, y), 3, linear_to_srgb(v * v));
            }
        }
        shot.plates[frame] = std::move(plate);
        shot.mattes[{0, frame}] = box_matte(kRegionBox);
    }
    return shot;
}

RegionPlan focused_region() {
    RegionPlan region = make_region(flat_texture({0.5f, 0.5f, 0.5f}));
    region.focus = 1;
    for (int f = 1; f <= kEnd; ++f)
        region.focus_frames.push_back(f);
    return region;
}

std::vector<int> frames_read(const AnalysisStore& store) {
    std::vector<int> out;
    for (int f = 1; f <= kEnd; ++f)
        if (store.has({0, f, AnalysisKind::kFocus})) out.push_back(f);
    return out;
}

void read(const MemoryShot& shot, const ShotPlan& plan, MemoryAnalysisStore& store) {
    int steps = 0;
    const PassContext context{shot, plan, {}, [&](int, double) { ++steps; }, nullptr};
    const int expected = count_focus_steps(plan, store);
    ASSERT_TRUE(read_focus(context, store));
    EXPECT_EQ(steps, expected);
    EXPECT_EQ(count_focus_steps(plan, store), 0);
}

TEST(FocusFrames, TheGridGoesByTheFramesNumbers) {
    RegionPlan region = focused_region();
    EXPECT_EQ(focus_grid(region), (std::vector<int>{1, 4, 8, 12, 16, 20, 21}));
    EXPECT_EQ(focus_frames_between(region, 4, 8), (std::vector<int>{5, 6, 7}));
    ShotPlan one = make_plan(region, 21, 21);
    EXPECT_EQ(needed_focus_frames(one, region), (std::vector<int>{8, 12, 16, 20, 21}));
    region.focus = 0;
    EXPECT_TRUE(needed_focus_frames(one, region).empty());
    region.focus = 1;
    // Both sides of a gap.
    std::erase(region.focus_frames, 10);
    EXPECT_EQ(focus_grid(region), (std::vector<int>{1, 4, 8, 9, 11, 12, 16, 20, 21}));
}

TEST(FocusFrames, PaintedMattesArePropagatedToThem) {
    RegionPlan region = focused_region();
    const ShotPlan plan = make_plan(region, 5, 5);
    EXPECT_EQ(analysed_span(plan, region).last, 5);
    region.matte_keys = {1};
    EXPECT_TRUE(focus_needs_propagation(region));
    EXPECT_EQ(analysed_span(plan, region).last, 20);
}

TEST(FocusPass, SteadyFocusIsReadOnEveryFourthFrame) {
    const MemoryShot shot = striped_wall([](int) { return 1.8f; });
    const ShotPlan plan = make_plan(focused_region(), 1, kEnd);
    MemoryAnalysisStore store;
    read(shot, plan, store);
    EXPECT_EQ(frames_read(store), (std::vector<int>{1, 4, 8, 12, 16, 20, 21}));
    for (int f = 1; f <= kEnd; ++f) {
        const auto state = focus_on(plan, store, 0, f);
        ASSERT_TRUE(state);
        EXPECT_NEAR(state->blur_px, 1.8f, 0.35f) << f;
    }
}

TEST(FocusPass, OneFrameOutOfFocusDoesNotShowInTheOthers) {
    const MemoryShot shot = striped_wall([](int f) { return f == 12 ? 2.6f : 1.2f; });
    const ShotPlan plan = make_plan(focused_region(), 1, kEnd);
    MemoryAnalysisStore store;
    read(shot, plan, store);
    EXPECT_EQ(frames_read(store),
              (std::vector<int>{1, 4, 8, 9, 10, 11, 12, 13, 14, 15, 16, 20, 21}));
    const float usual = focus_on(plan, store, 0, 1)->blur_px;
    for (int f = 2; f <= kEnd; ++f)
        EXPECT_NEAR(focus_on(plan, store, 0, f)->blur_px, usual, 0.08f * usual) << f;
}

TEST(FocusPass, AFramesFocusDoesNotDependOnTheFramesThatAreRendered) {
    const auto pull = [](int f) {
        return 0.6f + 2.0f * std::clamp(static_cast<float>(f - 6) / 10, 0.0f, 1.0f);
    };
    const MemoryShot shot = striped_wall(pull);
    const ShotPlan whole = make_plan(focused_region(), 1, kEnd);
    MemoryAnalysisStore of_whole;
    read(shot, whole, of_whole);
    for (const int f : {1, 5, 9, 13, 21}) {
        const ShotPlan one = make_plan(focused_region(), f, f);
        MemoryAnalysisStore of_one;
        read(shot, one, of_one);
        const auto a = focus_on(whole, of_whole, 0, f), b = focus_on(one, of_one, 0, f);
        ASSERT_TRUE(a && b);
        EXPECT_EQ(a->blur_px, b->blur_px) << f;
        EXPECT_EQ(a->confidence, b->confidence) << f;
        EXPECT_NEAR(a->blur_px, pull(f), 0.3f + 0.15f * pull(f)) << f;
    }
}

TEST(FocusPass, ReadingsSurviveTheStore) {
    FocusReading reading;
    reading.blur_px = 1.25f, reading.error_px = 0.1f, reading.confidence = 0.5f;
    reading.slope = {1, 2, 3, 4, 5, 0.25f};
    reading.has_lens = true;
    reading.lens = {1, 2, 3, 0.5f, 0, 1};
    Bytes bytes = encode(reading);
    const auto back = decode_focus(bytes);
    ASSERT_TRUE(back);
    EXPECT_EQ(encode(*back), bytes);
    bytes.pop_back();
    EXPECT_FALSE(decode_focus(bytes));
    MemoryAnalysisStore empty;
    EXPECT_FALSE(focus_on(make_plan(focused_region(), 1, 2), empty, 0, 1));
}

TEST(FocusPass, AFrameThatCannotBeReadIsNamed) {
    MemoryShot shot = striped_wall([](int) { return 1.0f; });
    shot.plates.erase(8);
    const ShotPlan plan = make_plan(focused_region(), 1, 4);
    MemoryAnalysisStore store;
    const PassContext context{shot, plan, {}, {}, nullptr};
    const Status done = read_focus(context, store);
    ASSERT_FALSE(done);
    EXPECT_NE(done.error().text().find("8"), std::string::npos);
}

}  // namespace
}  // namespace weft

// Focus over time: what single frames get wrong does not show, and a pull is followed.
#include "engine/composite/focus_course.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/composite/texture_focus.h"
#include "engine/core/rng.h"

namespace weft {
namespace {

FocusReading reading(float blur_px, float confidence = 1, float error_px = 0.02f) {
    FocusReading out;
    out.blur_px = blur_px;
    out.confidence = confidence;
    out.error_px = error_px;
    return out;
}

// A reading of every kFocusStep-th frame, and of all between two that differ.
template <class Read>
std::vector<TimedReading> read_clip(int last, Read&& read) {
    std::vector<TimedReading> out;
    for (int f = 0; f <= last; f += kFocusStep) {
        const FocusReading here = read(f);
        if (!out.empty() && differ(out.back().reading, here)) {
            for (int between = f - kFocusStep + 1; between < f; ++between)
                out.push_back({between, read(between)});
        }
        out.push_back({f, here});
    }
    return out;
}

// The largest change of the blur from one frame to the next, as a share of it.
float largest_step(const std::vector<TimedReading>& readings, int last) {
    float out = 0;
    for (int f = 1; f <= last; ++f) {
        const float before = focus_at(f - 1, readings).blur_px, now = focus_at(f, readings).blur_px;
        out = std::max(out, std::abs(now - before) / std::min(now, before));
    }
    return out;
}

TEST(FocusCourse, FramesThatSeeLittleFollowTheOthers) {
    // A faint cloth: on a third of the frames few and soft edges are found.
    const auto faint = [](int f) { return f % 3 == 1 ? reading(2.5f, 0.2f, 0.6f) : reading(0.7f); };
    const auto readings = read_clip(40, faint);
    for (int f = 0; f <= 40; ++f) {
        EXPECT_NEAR(focus_at(f, readings).blur_px, 0.7f, 0.07f) << f;
        EXPECT_GT(focus_at(f, readings).confidence, 0.9f) << f;
    }
    EXPECT_LT(largest_step(readings, 40), 0.02f);
}

TEST(FocusCourse, OneFrameThatIsSureOfSomethingElseIsNotBelieved) {
    const auto readings =
        read_clip(40, [](int f) { return f == 20 ? reading(2.4f) : reading(0.8f); });
    EXPECT_GT(readings.size(), 12u);  // its neighbours were asked
    for (int f = 0; f <= 40; ++f)
        EXPECT_NEAR(focus_at(f, readings).blur_px, 0.8f, 0.08f) << f;
}

TEST(FocusCourse, APullOfFocusIsFollowedWithoutLagOrSteps) {
    const auto pull = [](float f) {
        const float t = std::clamp((f - 14) / 12, 0.0f, 1.0f);
        return 0.6f + 2.4f * t * t * (3 - 2 * t);
    };
    const auto readings =
        read_clip(40, [&](int f) { return reading(pull(static_cast<float>(f))); });
    for (int f = 0; f <= 40; ++f) {
        const float wanted = pull(static_cast<float>(f));
        EXPECT_NEAR(focus_at(f, readings).blur_px, wanted, 0.05f + 0.06f * wanted) << f;
    }
    // The pull itself changes by at most 0.3 px a frame.
    float step = 0;
    for (int f = 1; f <= 40; ++f)
        step = std::max(step, focus_at(f, readings).blur_px - focus_at(f - 1, readings).blur_px);
    EXPECT_LT(step, 0.33f);
}

TEST(FocusCourse, NoiseOfTheReadingsIsAveraged) {
    Rng rng(3);
    const auto readings = read_clip(80, [&](int) {
        return reading(1.5f + 0.2f * static_cast<float>(rng.uniform() - 0.5), 0.6f, 0.08f);
    });
    EXPECT_LT(largest_step(readings, 80), 0.02f);
}

TEST(FocusCourse, WithoutReadingsNothingIsKnown) {
    EXPECT_EQ(focus_at(5, {}).blur_px, 0);
    EXPECT_EQ(focus_at(5, {{4, reading(0, 0)}}).confidence, 0);
    // Beyond reach.
    EXPECT_EQ(focus_at(40, {{4, reading(1)}}).blur_px, 0);
    EXPECT_NEAR(focus_at(7, {{4, reading(1)}}).blur_px, 1, 1e-6f);
}

TEST(FocusCourse, LensesAreMixedByTheirShares) {
    std::vector<TimedReading> readings;
    for (int f = 0; f <= 16; f += 4) {
        FocusReading r;
        r.has_lens = true;
        r.lens = {.constant = 1.0f + 0.01f * static_cast<float>(f), .highest = 1};
        readings.push_back({f, r});
    }
    const FocusState state = focus_at(8, readings);
    EXPECT_NEAR(state.lens_blur_px(0.5f), std::sqrt(1.08f), 0.01f);
    EXPECT_EQ(state.blur_px, 0);
}

// Squares of two greys that are `side` px wide.
ImageF3 squares(int side) {
    ImageF3 out(256, 192);
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            std::fill_n(out.pixel(x, y), 3, (x / side + y / side) % 2 == 0 ? 0.05f : 0.6f);
    return out;
}

TEST(TextureFocus, TheBlurThatIsNeededGrowsSmoothlyWithThePlates) {
    const TextureFocus focus = texture_focus(squares(16));
    EXPECT_LT(focus.own_px, 0.55f);
    EXPECT_GT(focus.own_px, 0);
    float before = focus.needed_px(1, 0.45f);
    EXPECT_EQ(before, 0);
    for (float plate = 0.46f; plate < 5; plate += 0.01f) {
        const float needed = focus.needed_px(1, plate);
        EXPECT_GE(needed, before - 1e-4f) << plate;
        EXPECT_LT(needed - before, 0.08f) << plate;
        before = needed;
    }
    EXPECT_NEAR(focus.needed_px(1, 2), 1.95f, 0.25f);
}

TEST(TextureFocus, ASoftTextureShownLargerIsSofterStill) {
    TextureFocus focus;
    focus.own_px = 1.2f;
    EXPECT_NEAR(focus.own_blur_px(1), 1.2f, 1e-5f);
    EXPECT_GT(focus.own_blur_px(2), 2.2f);
    EXPECT_LT(focus.own_blur_px(0.25f), 0.55f);
    EXPECT_EQ(focus.needed_px(2, 2.0f), 0);
    EXPECT_EQ(texture_focus(ImageF3(64, 64)).own_px, 0);
}

}  // namespace
}  // namespace weft

#include "app/session/where_to_correct.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/session/session_view.h"

namespace weft {
namespace {

TEST(WhereToCorrect, ListsAFrameOnceForItsWorstProblem) {
    std::vector<int> frames;
    std::vector<FrameMarks> marks(40);
    for (int k = 0; k < 40; ++k) {
        frames.push_back(k + 1);
        auto& mark = marks[static_cast<std::size_t>(k)];
        mark.confidence = k == 20 ? 0.2f : 0.95f;
        mark.drift = k == 20 ? 0.9f : 0.05f;
        mark.stretch = 1;
    }
    const auto hints = where_to_correct(frames, marks, {1}, {1});
    int named = 0;
    for (const CorrectionHint& hint : hints) {
        if (hint.frame != 21) continue;
        ++named;
        EXPECT_EQ(hint.kind, CorrectionHint::Kind::kDrift);
        EXPECT_FLOAT_EQ(hint.value, 0.9f);
    }
    EXPECT_EQ(named, 1);
    EXPECT_TRUE(where_to_correct(frames, marks, {}, {}).empty()) << "nothing to carry from";
}

TEST(WhereToCorrect, BeginsWhereALookPaysMost) {
    std::vector<int> frames;
    std::vector<FrameMarks> marks(60);
    for (int k = 0; k < 60; ++k) {
        frames.push_back(k + 1);
        auto& mark = marks[static_cast<std::size_t>(k)];
        // The longest bad stretch comes late, a short one early, a drift worse than both between.
        const bool is_short = k > 8 && k<12, is_long = k> 40 && k < 56;
        mark.confidence = is_short || is_long ? 0.3f : 0.95f;
        mark.drift = k > 22 && k < 28 ? 0.9f : 0.05f;
        mark.stretch = 1;
    }
    const auto hints = where_to_correct(frames, marks, {1}, {1});
    ASSERT_GE(hints.size(), 3U);
    const auto lies_in = [](const CorrectionHint& hint, int first, int last) {
        return hint.frame >= first && hint.frame <= last;
    };
    EXPECT_TRUE(lies_in(hints[0], 24, 28)) << hints[0].frame;
    EXPECT_TRUE(lies_in(hints[1], 42, 56)) << hints[1].frame;
    const auto early = std::find_if(hints.begin(), hints.end(), [&](const CorrectionHint& hint) {
        return lies_in(hint, 10, 12);
    });
    EXPECT_TRUE(early == hints.end() || early - hints.begin() > 1);
}

}  // namespace
}  // namespace weft

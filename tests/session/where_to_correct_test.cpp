#include "app/session/where_to_correct.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace weft

#include "app/shot/frame_gaps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/frame_range.h"

namespace weft {
namespace {

using ::testing::ElementsAre;

std::vector<std::pair<int, int>> gaps(const std::vector<int>& present, FrameSpan span) {
    std::vector<std::pair<int, int>> out;
    for (const FrameSpan& gap : gaps_in(present, span))
        out.emplace_back(gap.first, gap.last);
    return out;
}

TEST(FrameGaps, AreTheMissingRuns) {
    EXPECT_THAT(gaps({1, 2, 3}, {1, 3}), ElementsAre());
    EXPECT_THAT(gaps({1, 2, 5, 7}, {1, 7}), ElementsAre(std::pair(3, 4), std::pair(6, 6)));
    EXPECT_THAT(gaps({2, 3}, {0, 5}), ElementsAre(std::pair(0, 1), std::pair(4, 5)));
    EXPECT_THAT(gaps({1, 9}, {3, 5}), ElementsAre(std::pair(3, 5)));
    EXPECT_THAT(gaps({}, {-2, -1}), ElementsAre(std::pair(-2, -1)));
}

TEST(FrameGaps, AWideGapIsOneRun) {
    const std::vector<int> ends{-kMaxFrameNumber, kMaxFrameNumber};
    EXPECT_THAT(gaps(ends, {ends[0], ends[1]}),
                ElementsAre(std::pair(1 - kMaxFrameNumber, kMaxFrameNumber - 1)));
    EXPECT_EQ(gaps_text(gaps_in(ends, {ends[0], ends[1]})), "frames -99999999-99999999");
}

TEST(FrameGaps, RunAroundAFrame) {
    const std::vector<int> present{1, 2, 3, 6, 8, 9};
    EXPECT_EQ(run_with(present, 2).first, 1);
    EXPECT_EQ(run_with(present, 2).last, 3);
    EXPECT_EQ(run_with(present, 6).first, 6);
    EXPECT_EQ(run_with(present, 6).last, 6);
    EXPECT_EQ(run_with(present, 8).last, 9);
    EXPECT_GT(run_with(present, 5).first, run_with(present, 5).last);
}

TEST(FrameGaps, TextIsShortened) {
    EXPECT_EQ(gaps_text({{3, 3}}), "frame 3");
    EXPECT_EQ(gaps_text({{3, 4}, {9, 9}}), "frames 3-4,9");
    std::vector<FrameSpan> many;
    for (int k = 0; k < 1000; ++k)
        many.push_back({3 * k, 3 * k});
    EXPECT_LT(gaps_text(many).size(), 110u);
}

}  // namespace
}  // namespace weft

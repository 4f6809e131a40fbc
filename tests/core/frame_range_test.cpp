#include "engine/core/frame_range.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

using Frames = std::vector<int>;

TEST(FrameList, ReadsWhatArtistsWrite) {
    EXPECT_EQ(parse_frame_list("7").value(), (Frames{7}));
    EXPECT_EQ(parse_frame_list("1-4").value(), (Frames{1, 2, 3, 4}));
    EXPECT_EQ(parse_frame_list("1-10x4").value(), (Frames{1, 5, 9}));
    EXPECT_EQ(parse_frame_list("-5--3").value(), (Frames{-5, -4, -3}));
    EXPECT_EQ(parse_frame_list("-100000000,100000000").value(), (Frames{-100000000, 100000000}));
    EXPECT_EQ(parse_frame_list("-1-1").value(), (Frames{-1, 0, 1}));
    EXPECT_EQ(parse_frame_list("9,1,4-5,4").value(), (Frames{1, 4, 5, 9}));
}

TEST(FrameList, RefusesWhatMeansNothing) {
    for (const char* text : {"", "a", "1-", "4-1", "1-5x0", "1-5x", "1,,2", "1 - 4", "1-9999999999",
                             "0-2000000", "1x2", "1-600000,1-600000", "100000001", "-100000001",
                             "2147483647", "-2147483648--2147483647"}) {
        const auto frames = parse_frame_list(text);
        ASSERT_FALSE(frames) << text;
        EXPECT_EQ(frames.error().code, ErrorCode::kUsage) << text;
    }
}

TEST(FrameList, FormatIsReadBackAsTheSameFrames) {
    for (const Frames& frames : {Frames{3}, Frames{1, 2}, Frames{1, 3}, Frames{1, 3, 5, 6, 7},
                                 Frames{-4, -3, -2, 10, 20, 30, 31}}) {
        EXPECT_EQ(parse_frame_list(format_frame_list(frames)).value(), frames)
            << format_frame_list(frames);
    }
    EXPECT_EQ(format_frame_list({1, 2, 3, 4}), "1-4");
    EXPECT_EQ(format_frame_list({1, 3, 5}), "1-5x2");
}

}  // namespace
}  // namespace weft

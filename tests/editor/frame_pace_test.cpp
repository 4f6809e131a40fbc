// When the window draws.
#include "app/editor/frame_pace.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

// Frames in two seconds of a driver that does not wait for the screen; a frame takes 1 ms.
int frames_in_two_seconds(FramePace& pace, WindowMoment moment) {
    int frames = 0;
    const double end_s = moment.now_s + 2;
    while (moment.now_s < end_s) {
        moment.now_s += pace.wait_s(moment);
        if (!pace.draws(moment)) continue;
        ++frames;
        moment.now_s += 0.001;
    }
    return frames;
}

TEST(FramePace, LeavesTheProcessorsToWhatIsWaitedFor) {
    FramePace pace;
    WindowMoment moment;
    moment.now_s = 10;
    moment.busy = true;
    EXPECT_NEAR(frames_in_two_seconds(pace, moment), 60, 10);
    moment.at_hand = true;
    moment.now_s = 20;
    EXPECT_NEAR(frames_in_two_seconds(pace, moment), 240, 20) << "a drag";
}

TEST(FramePace, DrawsAtOnceOnAnEventAndRestsAfterIt) {
    FramePace pace;
    WindowMoment moment;
    moment.now_s = 10;
    EXPECT_LE(frames_in_two_seconds(pace, moment), 3);
    moment.now_s = 20;
    EXPECT_FALSE(pace.draws(moment));
    moment.event = true;
    EXPECT_TRUE(pace.draws(moment));
    moment.event = false;
    EXPECT_LT(pace.wait_s(moment), 0.01) << "what it opens is laid out in a moment";
    ++moment.changes;
    EXPECT_TRUE(pace.draws(moment));
}

// Frames that are decoded, mattes that are propagated: hundreds a second are a few on the screen.
TEST(FramePace, ShowsWhatWorkersChangeTenTimesASecond) {
    FramePace pace;
    WindowMoment moment;
    moment.now_s = 10;
    (void)frames_in_two_seconds(pace, moment);
    int frames = 0;
    for (moment.now_s = 20; moment.now_s < 22; moment.now_s += 0.005) {
        ++moment.changes;
        frames += pace.draws(moment);
    }
    EXPECT_GE(frames, 15);
    EXPECT_LE(frames, 21);
    frames = 0;
    for (; moment.now_s < 24; moment.now_s += 0.005)
        frames += pace.draws(moment);
    EXPECT_GE(frames, 1) << "the last change, laid out";
    EXPECT_LE(frames, 2);
}

// Nobody has to move the mouse for it.
TEST(FramePace, TakesAwayWhatGoesByItself) {
    FramePace pace;
    WindowMoment moment;
    moment.now_s = 10;
    (void)frames_in_two_seconds(pace, moment);
    moment.now_s = 20;
    moment.passing = true;
    const int frames = frames_in_two_seconds(pace, moment);
    EXPECT_GE(frames, 3);
    EXPECT_LE(frames, 5);
}

}  // namespace
}  // namespace weft

// The playhead: where it goes, what it waits for, and what it wants decoded.
#include "app/preview/playback.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace weft::test {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;
using State = PlatePlayer::State;

Playback opened(std::vector<int> frames = {1001, 1002, 1004, 1005, 1006}) {
    Playback out;
    out.open(std::move(frames));
    return out;
}

std::vector<State> all_decoded(std::size_t count = 5) {
    return std::vector<State>(count, State::kCached);
}

TEST(Playback, GoesToFramesOfThePlateOnly) {
    Playback playback;
    EXPECT_FALSE(playback.go_to(3)) << "there is no plate";
    playback.open({1001, 1002, 1004});
    EXPECT_EQ(playback.frame(), 1001);
    EXPECT_TRUE(playback.go_to(1003));
    EXPECT_EQ(playback.frame(), 1004) << "the next one that there is";
    EXPECT_FALSE(playback.go_to(1004));
    EXPECT_TRUE(playback.go_to(900));
    EXPECT_EQ(playback.frame(), 1001);
    EXPECT_TRUE(playback.step(5));
    EXPECT_EQ(playback.frame(), 1004);
    EXPECT_FALSE(playback.step(1));
}

TEST(Playback, AnotherPlateKeepsTheFrameIfItHasIt) {
    Playback playback = opened();
    playback.go_to(1005);
    playback.close();
    EXPECT_EQ(playback.frame(), 1005);
    playback.open({1004, 1005});
    EXPECT_EQ(playback.frame(), 1005);
    playback.open({1, 2});
    EXPECT_EQ(playback.frame(), 1);
}

TEST(Playback, TurnsRoundOrEndsAtTheLastFrame) {
    Playback playback = opened();
    playback.set_mode(PlayMode::kPingPong);
    playback.go_to(1005);
    playback.play(1);
    playback.advance(0, 25, all_decoded());
    double now_s = 0;
    std::vector<int> seen;
    for (int k = 0; k < 3; ++k) {
        playback.advance(now_s += 0.0401, 25, all_decoded());
        seen.push_back(playback.frame());
    }
    EXPECT_THAT(seen, ElementsAre(1006, 1005, 1004));
    playback.set_mode(PlayMode::kOnce);
    playback.play(1);
    for (int k = 0; k < 6; ++k)
        playback.advance(now_s += 0.0401, 25, all_decoded());
    EXPECT_EQ(playback.frame(), 1006);
    EXPECT_EQ(playback.direction(), 0);
    playback.play(1);
    EXPECT_EQ(playback.frame(), 1001) << "it begins again";
}

TEST(Playback, MarksBoundTheRangeInEitherOrder) {
    Playback playback = opened();
    EXPECT_THAT(playback.range(), Pair(0, 4));
    EXPECT_FALSE(playback.marked());
    playback.mark(1005, 1002);
    EXPECT_EQ(playback.mark_in(), 1002);
    EXPECT_THAT(playback.range(), Pair(1, 3));
    playback.mark(std::nullopt, 1002);
    EXPECT_THAT(playback.range(), Pair(0, 1));
    playback.reset();
    EXPECT_THAT(playback.range(), Pair(0, 4));
}

TEST(Playback, PlaysInTimeAndRoundTheRange) {
    Playback playback = opened();
    playback.mark(1002, 1005);
    playback.go_to(1002);
    double now_s = 10;
    playback.advance(now_s, 10, all_decoded());
    playback.play(1);
    std::vector<int> seen;
    for (int k = 0; k < 4; ++k) {
        playback.advance(now_s += 0.101, 10, all_decoded());
        seen.push_back(playback.frame());
    }
    EXPECT_THAT(seen, ElementsAre(1004, 1005, 1002, 1004));
    playback.play(-1);
    playback.advance(now_s += 0.101, 10, all_decoded());
    EXPECT_EQ(playback.frame(), 1002);
    playback.stop();
    playback.advance(now_s += 1, 10, all_decoded());
    EXPECT_EQ(playback.frame(), 1002);
    EXPECT_EQ(playback.direction(), 0);
}

TEST(Playback, SkipsFramesWhereTheScreenIsSlowButNotMany) {
    Playback playback = opened();
    playback.advance(0, 24, all_decoded());
    playback.play(1);
    playback.advance(2.1 / 24, 24, all_decoded());
    EXPECT_EQ(playback.frame(), 1004) << "two frames are over";
    // After a long stop it goes on from there, instead of running after the clock.
    playback.advance(100, 24, all_decoded());
    const int after = playback.frame();
    playback.advance(100.001, 24, all_decoded());
    EXPECT_EQ(playback.frame(), after);
}

TEST(Playback, WaitsForAFrameThatIsNotDecoded) {
    Playback playback = opened();
    playback.advance(0, 10, {});
    playback.play(1);
    playback.advance(0.5, 10, {});
    EXPECT_EQ(playback.frame(), 1001) << "nothing is known of any frame";
    auto decoded = all_decoded();
    decoded[2] = State::kEmpty;
    decoded[1] = State::kFailed;
    playback.advance(0.61, 10, decoded);
    playback.advance(0.72, 10, decoded);
    EXPECT_EQ(playback.frame(), 1002) << "one that cannot be read is not waited for";
    playback.advance(1.5, 10, decoded);
    EXPECT_EQ(playback.frame(), 1002);
    decoded[2] = State::kCached;
    playback.advance(1.61, 10, decoded);
    EXPECT_EQ(playback.frame(), 1004);
}

TEST(Playback, MeasuresTheRateThatIsShown) {
    Playback playback = opened();
    playback.advance(0, 20, all_decoded());
    playback.play(1);
    for (double now_s = 0; now_s < 2; now_s += 1.0 / 60)
        playback.advance(now_s, 20, all_decoded());
    EXPECT_NEAR(playback.shown_fps(), 20, 2.5);
}

TEST(Playback, OneFrameIsNotPlayed) {
    Playback playback = opened({7});
    playback.play(1);
    EXPECT_EQ(playback.direction(), 0);
    EXPECT_THAT(playback.upcoming(), ElementsAre(7));
}

TEST(Playback, WantsWhatComesNext) {
    Playback playback = opened();
    EXPECT_THAT(playback.upcoming(), ElementsAre(1001, 1002, 1004, 1005, 1006));
    playback.go_to(1005);
    EXPECT_THAT(playback.upcoming(), ElementsAre(1005, 1006, 1001, 1002, 1004));
    playback.play(-1);
    EXPECT_THAT(playback.upcoming(), ElementsAre(1005, 1004, 1002, 1001, 1006));
    playback.mark(1002, 1005);
    EXPECT_THAT(playback.upcoming(), ElementsAre(1005, 1004, 1002));
    EXPECT_TRUE(Playback().upcoming().empty());
}

}  // namespace
}  // namespace weft::test

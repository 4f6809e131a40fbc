#include "engine/pipeline/matte_feed.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <thread>

#include "engine/core/parallel.h"
#include "tests/pipeline/memory_shot.h"

namespace weft {
namespace {

using namespace std::chrono_literals;

AnalysisKey matte_on(int frame) {
    return {0, frame, AnalysisKind::kMatte};
}

TEST(MatteFeed, TheTakerWaitsForTheMatte) {
    MemoryAnalysisStore store;
    MatteFeed feed(store);
    auto taken = std::async(std::launch::async, [&] { return feed.taker().get(matte_on(3)); });
    expect_ok(feed.maker().put(matte_on(2), {2}));
    EXPECT_EQ(taken.wait_for(20ms), std::future_status::timeout);
    expect_ok(feed.maker().put(matte_on(3), {3}));
    const auto got = taken.get();
    ASSERT_TRUE(got) << got.error().text();
    EXPECT_EQ(*got, Bytes{3});
}

TEST(MatteFeed, TheMakerIsHeldBackUntilItsMattesAreAskedFor) {
    MemoryAnalysisStore store;
    MatteFeed feed(store);
    std::atomic<int> made = 0;
    auto making = std::async(std::launch::async, [&] {
        for (int frame = 1; frame <= 10; ++frame, ++made)
            expect_ok(feed.maker().put(matte_on(frame), {1}));
        feed.end({});
    });
    while (made < MatteFeed::kMostAhead)
        std::this_thread::sleep_for(1ms);
    EXPECT_EQ(making.wait_for(50ms), std::future_status::timeout);
    EXPECT_EQ(made, MatteFeed::kMostAhead);
    // What lies far ahead is waited for, so the maker goes on to it.
    EXPECT_TRUE(feed.taker().get(matte_on(8)));
    EXPECT_GE(made, 7);
    feed.release(false);
    making.get();
    EXPECT_EQ(made, 10);
    EXPECT_TRUE(feed.made());
}

TEST(MatteFeed, TheTakerGetsTheMakersError) {
    MemoryAnalysisStore store;
    MatteFeed feed(store);
    auto taken = std::async(std::launch::async, [&] { return feed.taker().get(matte_on(1)); });
    feed.end(fail(ErrorCode::kMissingFrames, "Frame 1 is missing."));
    const auto got = taken.get();
    ASSERT_FALSE(got);
    EXPECT_EQ(got.error().code, ErrorCode::kMissingFrames);
    EXPECT_FALSE(feed.made());
}

TEST(MatteFeed, TheMakerStopsWhenTheTakersHaveFailed) {
    MemoryAnalysisStore store;
    MatteFeed feed(store);
    auto making = std::async(std::launch::async, [&] {
        Status put;
        for (int frame = 1; put && frame <= 1000; ++frame)
            put = feed.maker().put(matte_on(frame), {1});
        feed.end(put);
        return put;
    });
    feed.release(true);
    EXPECT_FALSE(making.get());
    EXPECT_TRUE(feed.made()) << "the takers' error is the one that counts";
}

constexpr int kKey = kFirst + 3;

// The wall behind a disc; its matte is painted on one frame.
class SideBySide : public ::testing::Test {
  protected:
    SideBySide() { shot_.keys[{0, kKey}] = box_matte(kRegionBox); }
    ~SideBySide() override { set_thread_count(0); }

    std::vector<Bytes> analysed(int threads, int primary) {
        set_thread_count(threads);
        RegionPlan region = make_region(sample_texture());
        region.matte_keys = {kKey};
        region.reference_frames = {primary};
        MemoryAnalysisStore store;
        const Status done = analyse_shot(shot_, make_plan(region), store, {}, {});
        EXPECT_TRUE(done) << done.error().text();
        std::vector<Bytes> all;
        for (int frame = kFirst; frame <= kLast; ++frame) {
            for (const AnalysisKind kind : {AnalysisKind::kMatte, AnalysisKind::kCoords}) {
                auto bytes = store.get({0, frame, kind});
                EXPECT_TRUE(bytes) << frame;
                all.push_back(bytes ? std::move(*bytes) : Bytes());
            }
        }
        return all;
    }

    MemoryShot shot_ = make_wall(true);
};

TEST_F(SideBySide, MattesAndTracksAreThoseOfOneThread) {
    for (const int primary : {kFirst, kKey, kLast})
        EXPECT_EQ(analysed(2, primary), analysed(1, primary)) << primary;
}

TEST_F(SideBySide, AMissingFrameIsTheErrorOfBoth) {
    set_thread_count(2);
    RegionPlan region = make_region(sample_texture());
    region.matte_keys = {kKey};
    shot_.plates.erase(kLast);
    MemoryAnalysisStore store;
    const Status done = analyse_shot(shot_, make_plan(region), store, {}, {});
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::kMissingFrames);
}

}  // namespace
}  // namespace weft

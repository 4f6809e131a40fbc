#include "engine/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace weft {
namespace {

class Parallel : public testing::Test {
  protected:
    ~Parallel() override { set_thread_count(0); }
};

TEST_F(Parallel, CallsEveryIndexOnce) {
    for (const int threads : {1, 2, 5}) {
        set_thread_count(threads);
        std::vector<std::atomic<int>> calls(1000);
        parallel_for(calls.size(), [&](std::size_t i) { ++calls[i]; });
        for (const auto& c : calls)
            EXPECT_EQ(c, 1);
    }
}

TEST_F(Parallel, NestedCallsRun) {
    set_thread_count(3);
    std::atomic<int> calls{0};
    parallel_for(8, [&](std::size_t) { parallel_for(8, [&](std::size_t) { ++calls; }); });
    EXPECT_EQ(calls, 64);
}

TEST_F(Parallel, AnIdleThreadHelpsInsideTheLastBody) {
    set_thread_count(3);  // whoever runs the last body, a helper is left
    std::atomic<bool> helped{false};
    parallel_for(2, [&](std::size_t i) {
        if (i == 0) return;
        // That helper has no body of its own left; soon it takes a part of this one.
        const std::thread::id own = std::this_thread::get_id();
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (!helped && std::chrono::steady_clock::now() < until) {
            parallel_for(2, [&](std::size_t) {
                helped = helped || std::this_thread::get_id() != own;
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            });
        }
    });
    EXPECT_TRUE(helped);
}

TEST_F(Parallel, AnErrorInsideANestedCallReachesTheOuterOne) {
    set_thread_count(3);
    std::atomic<int> calls{0};
    EXPECT_THROW(parallel_for(3,
                              [&](std::size_t i) {
                                  parallel_for(50, [&](std::size_t k) {
                                      ++calls;
                                      if (i == 2 && k == 7) throw std::runtime_error("seven");
                                  });
                              }),
                 std::runtime_error);
    // Called in place, the third one ends with its error; the others are whole.
    EXPECT_GE(calls, 108);
    EXPECT_LE(calls, 150);
}

TEST_F(Parallel, CallersFromSeveralThreadsDoNotMix) {
    set_thread_count(3);
    std::vector<std::thread> callers;
    std::atomic<int> sum{0};
    for (int t = 0; t < 4; ++t) {
        callers.emplace_back([&] {
            for (int k = 0; k < 50; ++k)
                parallel_for(10, [&](std::size_t) { ++sum; });
        });
    }
    for (auto& c : callers)
        c.join();
    EXPECT_EQ(sum, 4 * 50 * 10);
}

// Only two helpers are woken at first; work that lasts is passed on to all, also to those that
// slept while there were fewer threads.
TEST_F(Parallel, LongWorkReachesEveryThread) {
    for (const int threads : {6, 2, 6}) {
        set_thread_count(threads);
        std::atomic<int> begun{0};
        parallel_for(static_cast<std::size_t>(threads), [&](std::size_t) {
            ++begun;
            const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
            while (begun < threads && std::chrono::steady_clock::now() < until)
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            EXPECT_EQ(begun, threads);
        });
    }
}

TEST_F(Parallel, TheErrorOfTheLowestIndexIsReturned) {
    set_thread_count(3);
    std::atomic<int> calls{0};
    const Status status = parallel_try(20, [&](std::size_t i) -> Status {
        ++calls;
        if (i == 7 || i == 3) return fail(ErrorCode::kUnreadable, std::to_string(i));
        return {};
    });
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().sentence(), "3");
    EXPECT_EQ(calls, 20);
    EXPECT_TRUE(parallel_try(0, [](std::size_t) { return Status{}; }));
}

TEST_F(Parallel, RethrowsAfterAllHaveFinished) {
    set_thread_count(2);
    std::atomic<int> calls{0};
    EXPECT_THROW(parallel_for(20,
                              [&](std::size_t i) {
                                  ++calls;
                                  if (i == 3) throw std::runtime_error("three");
                              }),
                 std::runtime_error);
    EXPECT_EQ(calls, 20);
}

TEST_F(Parallel, RowsComeInBandsThatDoNotDependOnThreads) {
    set_thread_count(2);
    std::vector<int> band_of(25, -1);
    parallel_rows(25, 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y)
            band_of[static_cast<std::size_t>(y)] = y0;
    });
    for (int y = 0; y < 25; ++y)
        EXPECT_EQ(band_of[static_cast<std::size_t>(y)], y / 8 * 8);
}

}  // namespace
}  // namespace weft

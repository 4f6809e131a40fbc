#include "engine/core/work_thread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "engine/core/follow_up.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

TEST(WorkThread, RunsTasksInOrderInOneOtherThread) {
    std::vector<int> order;
    std::vector<std::thread::id> threads;
    {
        WorkThread worker;
        for (int i = 0; i < 50; ++i) {
            (void)worker.run([&, i] {
                order.push_back(i);
                threads.push_back(std::this_thread::get_id());
            });
        }
    }  // finishes all of them
    ASSERT_EQ(order.size(), 50u);
    for (int i = 0; i < 50; ++i)
        EXPECT_EQ(order[static_cast<std::size_t>(i)], i);
    for (const std::thread::id& id : threads) {
        EXPECT_EQ(id, threads.front());
        EXPECT_NE(id, std::this_thread::get_id());
    }
}

TEST(WorkThread, GivesResultsAndExceptions) {
    WorkThread worker;
    auto seven = worker.run([] { return 7; });
    auto thrown = worker.run([]() -> int { throw std::runtime_error("no"); });
    auto after = worker.run([] { return 8; });
    EXPECT_EQ(seven.get(), 7);
    EXPECT_THROW((void)thrown.get(), std::runtime_error);
    EXPECT_EQ(after.get(), 8) << "a task that throws must not end the thread";
}

TEST(FollowUp, IsAtMostOnePieceBehind) {
    set_thread_count(2);
    std::atomic<int> running = 0, most = 0, done = 0;
    FollowUp behind;
    for (int i = 0; i < 10; ++i) {
        ASSERT_TRUE(behind.run([&] {
            most = std::max(most.load(), ++running);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            --running, ++done;
            return Status{};
        }));
        EXPECT_GE(done, i) << "the piece before was not waited for";
    }
    EXPECT_TRUE(behind.finish());
    EXPECT_EQ(done, 10);
    EXPECT_EQ(most, 1);
    set_thread_count(0);
}

TEST(FollowUp, ReturnsThePieceBeforesErrorAndDropsThisOne) {
    set_thread_count(2);
    FollowUp behind;
    bool ran = false;
    ASSERT_TRUE(
        behind.run([]() -> Status { return fail(ErrorCode::kNoSpace, "The disk is full"); }));
    const Status second = behind.run([&] {
        ran = true;
        return Status{};
    });
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code, ErrorCode::kNoSpace);
    EXPECT_FALSE(ran);
    EXPECT_TRUE(behind.finish()) << "the error is returned once";
    set_thread_count(0);
}

TEST(FollowUp, RunsAtOnceWithOneThread) {
    set_thread_count(1);
    FollowUp behind;
    std::thread::id ran_in;
    EXPECT_TRUE(behind.run([&] {
        ran_in = std::this_thread::get_id();
        return Status{};
    }));
    EXPECT_EQ(ran_in, std::this_thread::get_id());
    set_thread_count(0);
}

}  // namespace
}  // namespace weft

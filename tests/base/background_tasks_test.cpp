#include "app/base/background_tasks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

namespace weft {
namespace {

using testing::ElementsAre;

TEST(BackgroundTasks, EndOnTheOwnersThreadInTheOrderOfTheirStart) {
    BackgroundTasks tasks;
    std::vector<int> ended;
    const auto owner = std::this_thread::get_id();
    for (int k = 0; k < 3; ++k)
        tasks.start([&, k]() -> BackgroundTasks::Finish {
            EXPECT_NE(std::this_thread::get_id(), owner);
            return [&, k] {
                EXPECT_EQ(std::this_thread::get_id(), owner);
                ended.push_back(k);
            };
        });
    EXPECT_FALSE(tasks.empty());
    tasks.finish(true);
    EXPECT_THAT(ended, ElementsAre(0, 1, 2));
    EXPECT_TRUE(tasks.empty());
}

TEST(BackgroundTasks, WhatIsNotDoneIsNotWaitedFor) {
    BackgroundTasks tasks;
    std::promise<void> go;
    bool ended = false;
    tasks.start([&, ready = go.get_future().share()]() -> BackgroundTasks::Finish {
        ready.wait();
        return [&] { ended = true; };
    });
    tasks.finish(false);
    EXPECT_FALSE(ended);
    EXPECT_FALSE(tasks.empty());
    go.set_value();
    tasks.finish(true);
    EXPECT_TRUE(ended);
}

TEST(BackgroundTasks, AnEndMayStartAnother) {
    BackgroundTasks tasks;
    bool ended = false;
    tasks.start([&]() -> BackgroundTasks::Finish {
        return [&] {
            tasks.start([&]() -> BackgroundTasks::Finish { return [&] { ended = true; }; });
        };
    });
    tasks.finish(true);
    EXPECT_TRUE(ended);
}

}  // namespace
}  // namespace weft

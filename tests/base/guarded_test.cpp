// Tests of Guarded.
#include "app/base/guarded.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <thread>
#include <vector>

namespace weft::test {
namespace {

TEST(Guarded, OneThreadAtATimeAccessesTheValue) {
    Guarded<int> count;
    *count.lock() = 0;
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            for (int k = 0; k < 2000; ++k)
                ++*count.lock();
        });
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(*count.lock(), 8000);
}

TEST(Guarded, TryingDoesNotWait) {
    Guarded<std::vector<int>> list;
    {
        const auto held = list.lock();
        ASSERT_TRUE(held);
        held->push_back(1);
        bool got = true;
        std::thread([&] { got = static_cast<bool>(list.try_lock()); }).join();
        EXPECT_FALSE(got);
    }
    const auto free = list.try_lock();
    ASSERT_TRUE(free);
    EXPECT_EQ(free->size(), 1u);
}

TEST(Guarded, WorksWithAConditionVariable) {
    Guarded<bool> ready;
    *ready.lock() = false;
    std::condition_variable wake;
    std::thread other([&] {
        *ready.lock() = true;
        wake.notify_all();
    });
    auto access = ready.lock();
    wake.wait(access.lock(), [&] { return *access; });
    EXPECT_TRUE(*access);
    access.lock().unlock();
    other.join();
}

}  // namespace
}  // namespace weft::test

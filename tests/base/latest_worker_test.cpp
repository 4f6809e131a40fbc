// The newest request wins, a pending one is not repeated, and callers never wait.
#include "app/base/latest_worker.h"

#include <gtest/gtest.h>

#include <chrono>
#include <latch>
#include <string>
#include <vector>

namespace weft::test {
namespace {

using Words = LatestWorker<std::string, std::string>;

// Waits until `done`, at most a minute.
template <class Done>
bool wait(Done&& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!done()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::yield();
    }
    return true;
}

// Work that blocks until it is released.
struct Held {
    std::atomic<bool> begun = false, go = false, cancelled = false;
    std::atomic<int> runs = 0;
    Words::Work work(std::string answer, bool gives_up = false) {
        return [this, answer, gives_up](const CancelToken& token) -> std::optional<std::string> {
            ++runs;
            begun = true;
            wait([&] { return go || (gives_up && token.cancelled()); });
            cancelled = token.cancelled();
            if (gives_up && token.cancelled()) return std::nullopt;
            return answer;
        };
    }
};

std::optional<std::string> say(const std::string& word) {
    return word;
}

TEST(LatestWorker, AnswersAndKeepsTheAnswer) {
    Words worker;
    EXPECT_EQ(worker.newest(), nullptr);
    EXPECT_FALSE(worker.busy());
    std::atomic<int> runs = 0;
    const auto ask = [&] {
        return worker.ask("key", [&](const CancelToken&) {
            ++runs;
            return say("answer");
        });
    };
    EXPECT_EQ(ask(), nullptr);
    ASSERT_TRUE(wait([&] { return ask() != nullptr; }));
    EXPECT_EQ(*ask(), "answer");
    EXPECT_EQ(*worker.try_read("key"), "answer");
    EXPECT_EQ(*worker.newest(), "answer");
    EXPECT_EQ(worker.try_read("another"), nullptr);
    EXPECT_FALSE(worker.busy());
    EXPECT_EQ(runs, 1);
}

// Repeats the request during the work, as drawing does; the work must not run again.
TEST(LatestWorker, APendingRequestIsNotRepeated) {
    Words worker;
    Held held;
    (void)worker.ask("key", held.work("answer"));
    ASSERT_TRUE(wait([&] { return held.begun.load(); }));
    for (int frame = 0; frame < 100; ++frame) {
        EXPECT_EQ(worker.ask("key", held.work("answer")), nullptr) << "and it does not wait";
        EXPECT_EQ(worker.try_read("key"), nullptr);
        EXPECT_TRUE(worker.busy());
    }
    held.go = true;
    ASSERT_TRUE(wait([&] { return worker.ask("key", held.work("answer")) != nullptr; }));
    // Any job posted after it would have run before this answer.
    ASSERT_TRUE(wait([&] {
        return worker.ask("next", [](const CancelToken&) { return say("next"); }) != nullptr;
    }));
    EXPECT_EQ(held.runs, 1);
    EXPECT_FALSE(held.cancelled);
}

TEST(LatestWorker, OnlyTheNewestWaitingRequestIsAnswered) {
    Words worker;
    Held first;
    std::vector<std::string> ran;
    const auto noted = [&](std::string word) {
        return [&ran, word](const CancelToken&) {
            ran.push_back(word);
            return say(word);
        };
    };
    (void)worker.ask("first", first.work("first"));
    ASSERT_TRUE(wait([&] { return first.begun.load(); }));
    for (const char* word : {"second", "third", "fourth"})
        EXPECT_EQ(worker.ask(word, noted(word)), nullptr);
    first.go = true;
    ASSERT_TRUE(wait([&] { return worker.try_read("fourth") != nullptr; }));
    EXPECT_TRUE(first.cancelled) << "nobody waited for it any more";
    EXPECT_EQ(ran, std::vector<std::string>{"fourth"});
    EXPECT_EQ(worker.try_read("first"), nullptr) << "it was replaced";
}

TEST(LatestWorker, ARequestWithoutAnAnswerCanBeRepeated) {
    Words worker;
    std::atomic<int> runs = 0;
    const auto second_time = [&](const CancelToken&) {
        return ++runs < 2 ? std::optional<std::string>() : say("at last");
    };
    ASSERT_TRUE(wait([&] { return worker.ask("key", second_time) != nullptr; }));
    EXPECT_EQ(runs, 2);
    // A request that was abandoned for a newer one can be repeated.
    Held held;
    (void)worker.ask("held", held.work("held", true));
    ASSERT_TRUE(wait([&] { return held.begun.load(); }));
    (void)worker.ask("key", [](const CancelToken&) { return say("anew"); });
    ASSERT_TRUE(wait([&] { return worker.try_read("key") != nullptr; }));
    held.go = true;
    ASSERT_TRUE(wait([&] { return worker.ask("held", held.work("held")) != nullptr; }));
    EXPECT_EQ(held.runs, 2);
}

TEST(LatestWorker, ReportsEachAnswer) {
    std::atomic<int> arrived = 0;
    Words worker([&] { ++arrived; });
    for (const char* word : {"a", "b", "c"})
        ASSERT_TRUE(wait(
            [&] { return worker.ask(word, [word](const CancelToken&) { return say(word); }); }));
    EXPECT_TRUE(wait([&] { return arrived == 3; }));
}

TEST(LatestWorker, DropsTheWaitingRequestOnDestruction) {
    Held held;
    std::atomic<bool> ran = false;
    {
        Words worker;
        (void)worker.ask("held", held.work("held", true));
        ASSERT_TRUE(wait([&] { return held.begun.load(); }));
        (void)worker.ask("waits", [&](const CancelToken& token) {
            ran = !token.cancelled();
            return say("waits");
        });
    }
    EXPECT_TRUE(held.cancelled);
    EXPECT_FALSE(ran) << "dropped, or told at once that nobody waits";
}

TEST(LatestWorker, AcceptsRequestsOfManyThreads) {
    Words worker;
    std::latch all(4);
    std::vector<std::thread> askers;
    for (int t = 0; t < 4; ++t)
        askers.emplace_back([&, t] {
            all.arrive_and_wait();
            for (int k = 0; k < 500; ++k) {
                const std::string key = std::to_string((k + t) % 3);
                const auto got = worker.ask(key, [key](const CancelToken&) { return say(key); });
                if (got) {
                    EXPECT_EQ(*got, key);
                }
            }
        });
    for (std::thread& asker : askers)
        asker.join();
    ASSERT_TRUE(wait([&] {
        return worker.ask("end", [](const CancelToken&) { return say("end"); }) != nullptr;
    }));
}

TEST(Published, ReturnsTheNewest) {
    Published<int> number(1);
    EXPECT_EQ(*number.get(), 1);
    number.put(2);
    number.put(3);
    EXPECT_EQ(*number.get(), 3);
    EXPECT_EQ(*number.get(), 3);
    EXPECT_EQ(Published<int>().get(), nullptr);
}

}  // namespace
}  // namespace weft::test

// Killed at random moments while painting: what was finished is there, and no file is damaged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <fstream>
#include <random>
#include <thread>

#include "app/project/project_file.h"
#include "engine/media/image_files.h"
#include "tests/editor/program.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;

TEST(Kill, EveryFinishedStrokeSurvives) {
    std::mt19937 random(std::random_device{}());
    constexpr int kRounds = WEFT_KILL_ROUNDS;
    int survived = 0;
    for (int round = 0; round < kRounds; ++round) {
        const Sandbox sandbox;
        {
            std::ofstream script(sandbox.in("script.json"));
            script << "[{\"wait_for\": \"plate\"}, {\"key\": \"Ctrl+Shift+N\"}, {\"key\": \"B\"}";
            for (int k = 0; k < 40; ++k) {
                script << ", {\"stroke\": [[" << 100 + 10 * k << ", 200], [" << 140 + 10 * k
                       << ", 260]]}, {\"times\": \"" << sandbox.in("strokes")
                       << "\", \"label\": \"stroke\"}, {\"wait\": 0.15}";
            }
            script << "]";
        }
        const pid_t pid = start(sandbox, {"edit", "--demo", "--script", sandbox.in("script.json"),
                                          "--size", "960x600"});
        // Some strokes first; then any moment.
        const auto count_strokes = [&] {
            std::ifstream file(sandbox.in("strokes"));
            int lines = 0;
            for (std::string line; std::getline(file, line);)
                ++lines;
            return lines;
        };
        for (int k = 0; k < 1200 && count_strokes() < 3; ++k) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            if (has_ended(pid)) break;
        }
        const int finished = count_strokes();
        if (finished < 3) {
            ::kill(pid, SIGKILL);
            const Finished done = finish(sandbox, pid);
            GTEST_SKIP() << "The editor did not start: " << done.errors;
        }
        std::this_thread::sleep_for(
            std::chrono::milliseconds(1000 + static_cast<int>(random() % 1500)));
        ::kill(pid, SIGKILL);
        (void)finish(sandbox, pid);
        const fs::path folder = fs::path(sandbox.in("home")) / ".local/state/weft/recovery";
        int snapshots = 0;
        for (const auto& entry : fs::directory_iterator(folder)) {
            if (entry.path().extension() != ".weft" ||
                entry.path().filename().string().starts_with('.'))
                continue;
            ++snapshots;
            const auto project = load_project(entry.path().string());
            ASSERT_TRUE(project) << project.error().text();
            ASSERT_EQ(project->regions.size(), 4u);
            const auto& keys = project->regions.back()->matte->keyframes;
            ASSERT_EQ(keys.size(), 1u);
            const auto matte = read_matte(keys.begin()->second.path, {}, {960, 540});
            ASSERT_TRUE(matte) << matte.error().text();
            // The middle of every stroke that was finished a second before.
            for (int k = 0; k < finished; ++k)
                EXPECT_GT(matte->at(120 + 10 * k, 230), 128) << "stroke " << k;
        }
        EXPECT_EQ(snapshots, 1);
        survived += snapshots;
    }
    EXPECT_EQ(survived, kRounds);
}

}  // namespace
}  // namespace weft::test

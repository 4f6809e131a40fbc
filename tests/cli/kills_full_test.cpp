// A render killed at any moment and resumed gives the bytes of an uninterrupted one.
#include <chrono>
#include <cstdlib>

#include "engine/core/rng.h"
#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;

class Kills : public CliTest {
  protected:
    Words shot(const Words& more) const {
        return with_options({"replace", "--plate", "frames/####.png", "--matte", "masks/####.png",
                             "--texture", "sample.png", "-o", "out/####.png", "--quality", "draft",
                             "--backend", "cpu", "--refine", "0", "--movie", "review.mkv"},
                            more);
    }
    Words hidden_in(const std::string& folder) const {
        Words out;
        for (const auto& entry : fs::recursive_directory_iterator(folder_ / folder))
            if (entry.path().filename().string().find(".weft-") != std::string::npos)
                out.push_back(entry.path().string());
        return out;
    }
};

TEST_F(Kills, AtRandomMomentsAreResumedToTheSameBytes) {
    WEFT_NEEDS_MOVIES();
    make_shot(8);
    const auto start = std::chrono::steady_clock::now();
    expect_success(run(shot({"-o", "whole/####.png", "--movie", "whole.mkv"})));
    const auto whole_us = std::chrono::duration_cast<std::chrono::microseconds>(
                              std::chrono::steady_clock::now() - start)
                              .count();
    const auto whole = contents("whole");
    ASSERT_EQ(whole.size(), 8u);
    const char* given = std::getenv("WEFT_KILLS");
    const int kills = given ? std::atoi(given) : 200;
    Rng rng(2026);
    int killed = 0, rounds = 0;
    // Runs that end before their signal are not counted.
    while (killed < kills && rounds < 3 * kills) {
        ++rounds;
        fs::remove_all(folder_ / "out");
        fs::remove(folder_ / "review.mkv");
        if (rounds % 2 == 0) fs::remove_all(folder_ / "home/cache");
        Words more{"--resume"};
        if (rounds % 3 == 0) more.push_back("--no-cache");
        options_.signal = SIGKILL;
        // Kills the resumed run again, twice.
        for (int blow = 0; blow < 1 + rounds % 3; ++blow) {
            options_.signal_after = std::chrono::microseconds(
                1 + static_cast<long>(rng.uniform() * static_cast<double>(whole_us)));
            const int exit = run(shot(more)).exit;
            ASSERT_TRUE(exit == 0 || exit == 128 + SIGKILL) << exit;
            if (exit != 0) ++killed;
        }
        options_.signal = 0;
        const Outcome resumed = run(shot(more));
        ASSERT_EQ(resumed.exit, 0) << resumed.err;
        ASSERT_EQ(contents("out"), whole) << "round " << rounds;
        ASSERT_EQ(bytes("review.mkv"), bytes("whole.mkv")) << "round " << rounds;
        ASSERT_THAT(hidden_in(""), IsEmpty()) << "round " << rounds;
    }
    EXPECT_GE(killed, kills);
    std::printf("%d kills in %d rounds\n", killed, rounds);
}

}  // namespace
}  // namespace weft::test

// The contract with scripts and farms: streams, progress, frame numbers, existing files, signals.
#include <nlohmann/json.hpp>

#include <csignal>
#include <sstream>

#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSubsetOf;
using ::testing::MatchesRegex;

using Contract = CliTest;

Words lines(const std::string& text) {
    Words out;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        out.push_back(line);
    return out;
}

TEST_F(Contract, PlainProgressIsOneLineAFrameOnStdout) {
    make_shot(3, 1042);
    const Outcome outcome = run_replace();
    expect_success(outcome);
    EXPECT_THAT(outcome.err, IsEmpty());
    int rendered = 0;
    for (const std::string& line : lines(outcome.out)) {
        EXPECT_THAT(line, MatchesRegex("(analyse )?frame [0-9]+ [0-9]+/[0-9]+ [0-9.]+% [0-9.]+s"));
        rendered += line.starts_with("frame 104");
    }
    EXPECT_EQ(rendered, 3);
    EXPECT_THAT(outcome.out, HasSubstr(" 3/3 100.0% "));
}

TEST_F(Contract, JsonProgressIsOneObjectALine) {
    make_shot(2);
    const Outcome outcome = run_replace({"--progress", "json"});
    expect_success(outcome);
    int rendered = 0;
    for (const std::string& line : lines(outcome.out)) {
        const Json event = Json::parse(line);
        for (const char* key : {"stage", "frame", "done", "total", "seconds"})
            EXPECT_TRUE(event.contains(key)) << line;
        rendered += event["stage"] == "render";
    }
    EXPECT_EQ(rendered, 2);
}

TEST_F(Contract, JsonPutsOneObjectOnStdoutAndProgressOnStderr) {
    make_shot(2);
    const Outcome outcome = run_replace({"--json", "--report", "report.json", "--threads", "1"});
    expect_success(outcome);
    Json report = Json::parse(outcome.out);
    EXPECT_EQ(report["exit_code"], 0);
    report.erase("exit_code");
    for (const char* key : {"frames", "seconds_per_stage", "fps", "peak_rss_bytes", "textures",
                            "settings", "warnings", "backend", "spaces"})
        EXPECT_TRUE(report.contains(key)) << key;
    EXPECT_EQ(report["frames"].size(), 2u);
    EXPECT_EQ(report["frames"][0]["path"], in("out/0001.png")) << "paths are absolute";
    EXPECT_EQ(report["spaces"]["plate"], "srgb");
    EXPECT_GT(report["peak_rss_bytes"].get<double>(), 1e6);
    EXPECT_EQ(Json::parse(bytes("report.json")), report);
    EXPECT_THAT(outcome.err, HasSubstr("frame 2 2/2"));
}

TEST_F(Contract, ADryRunPrintsAnEstimateAndWritesNothing) {
    make_shot(2);
    const Outcome outcome = run_replace({"--dry-run", "--threads", "2"});
    expect_success(outcome);
    EXPECT_THAT(outcome.out, HasSubstr("frames   1-2 (2)"));
    EXPECT_THAT(outcome.out, HasSubstr("s on 2 threads of the CPU, "));
    EXPECT_FALSE(fs::exists(in("out")));
}

TEST_F(Contract, NoProgressMeansSilence) {
    make_shot(2);
    const Outcome outcome = run_replace({"--progress", "none"});
    expect_success(outcome);
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(outcome.err, IsEmpty());
}

TEST_F(Contract, FrameNumbersInAreFrameNumbersOut) {
    make_shot(6, -3);
    expect_success(run_replace({"--frames", "-2--1"}));
    EXPECT_EQ(names("out"), (Words{"-0001.png", "-0002.png"}));
    expect_success(run_replace({"--frames=-3-2x2", "-o", "b/f.@@@.png"}));
    EXPECT_EQ(names("b"), (Words{"f.-001.png", "f.-003.png", "f.001.png"}));
    expect_success(run_replace({"--frames", "2,-3", "-o", "c/%02d.png"}));
    EXPECT_EQ(names("c"), (Words{"-3.png", "02.png"}));  // the sign is one of printf's places
    // A frame does not depend on the other frames of the run.
    EXPECT_EQ(bytes("b/f.-003.png"), bytes("c/-3.png"));
}

TEST_F(Contract, ExistingFramesAreRefusedReplacedOrKept) {
    make_shot(4);
    expect_success(run_replace());
    const auto whole = contents("out");
    ASSERT_EQ(whole.size(), 4u);
    const std::string third = bytes("out/0003.png");

    expect_failure(run_replace({"-o", "out/####.png"}), 2,
                   {"out/0001.png", "--overwrite", "--skip-existing"});
    EXPECT_EQ(contents("out"), whole);

    // Frames of other programs are not replaced.
    const std::string fourth = bytes("out/0004.png");
    put_picture("out/0004.png", pattern_picture({16, 16}, 1));
    expect_failure(run_replace({"--skip-existing"}), 2, {"out/0004.png", "--overwrite"});
    put("out/0004.png", fourth);

    // One is missing, one is damaged.
    fs::remove(folder_ / "out/0002.png");
    put("out/0003.png", third.substr(0, third.size() / 2));
    const Outcome resumed = run_replace({"--skip-existing", "--json"});
    expect_success(resumed);
    EXPECT_EQ(contents("out"), whole);
    EXPECT_TRUE(Json::parse(resumed.out)["frames"][0].value("skipped", false));

    put("out/0001.png", "rubbish");
    expect_success(run_replace({"--overwrite"}));
    EXPECT_EQ(contents("out"), whole);
}

TEST_F(Contract, ExistingMovieStopsTheRunBeforeItsFirstFrame) {
    WEFT_NEEDS_MOVIES();
    make_shot(2);
    put("review.mkv", "an older one");
    expect_failure(run_replace({"--movie", "review.mkv"}), 2, {"review.mkv", "--overwrite"});
    EXPECT_EQ(bytes("review.mkv"), "an older one");
    EXPECT_THAT(names("out"), IsEmpty());
}

// Synthesizing a plane for every frame keeps the program busy long enough to be stopped.
class Stopped : public CliTest {
  protected:
    Words slow(const Words& more) const {
        return with_options({"replace", "--plate", "frames/####.png", "--matte", "masks/####.png",
                             "--texture", "sample.png", "-o", "out/####.png", "--temporal", "none",
                             "--quality", "draft", "--threads", "1", "--backend", "cpu"},
                            more);
    }
};

TEST_F(Stopped, TerminatedRunLeavesWholeFramesAndResumesToTheSameBytes) {
    make_shot(16);
    options_.signal_when = folder_ / "out/0001.png";
    options_.signal = SIGTERM;
    expect_failure(run(slow({})), 143, {});
    const auto part = contents("out");
    EXPECT_GE(part.size(), 1u);
    EXPECT_LT(part.size(), 16u);
    EXPECT_THAT(names("tmp"), IsEmpty());

    options_.signal = 0;
    expect_success(run(slow({"--skip-existing"})));
    expect_success(run(slow({"-o", "whole/####.png", "--threads", "2"})));
    const auto whole = contents("whole");
    EXPECT_EQ(contents("out"), whole);
    for (const auto& [name, hash] : part)
        EXPECT_EQ(hash, whole.at(name)) << name;
}

TEST_F(Stopped, AnInterruptedRunHasItsExitCode) {
    WEFT_NEEDS_MOVIES();
    make_shot(16);
    options_.signal_when = folder_ / "out/0001.png";
    options_.signal = SIGINT;
    expect_failure(run(slow({"--movie", "review.mkv", "--no-cache"})), 130, {});
    EXPECT_THAT(names("tmp"), IsEmpty());
    EXPECT_FALSE(fs::exists(folder_ / "review.mkv"));
    EXPECT_THAT(names("out"), IsSubsetOf(names("frames")));
    for (const std::string& name : names(""))
        EXPECT_FALSE(name.starts_with(".")) << name;
}

TEST_F(Contract, AMissingBackendListsTheAvailableOnes) {
    make_shot(2);
    const Outcome outcome = run_replace({"--backend", "cuda"});
    if (outcome.exit == 0) GTEST_SKIP() << "there is a CUDA device here";
    expect_failure(outcome, 5, {"CUDA", "cpu", "(--backend)"});
    EXPECT_THAT(names("out"), IsEmpty());
}

TEST_F(Contract, SameBytesForAnyThreadsAndForASecondRun) {
    make_shot(4);
    const Words base{"replace",   "--plate",    "frames/####.png", "--matte", "masks/####.png",
                     "--texture", "sample.png", "--backend",       "cpu"};
    const auto render = [&](const std::string& out, const Words& more) {
        Words words = base;
        words.insert(words.end(), {"-o", out + "/####.png"});
        words.insert(words.end(), more.begin(), more.end());
        expect_success(run(words));
        return contents(out);
    };
    const auto two = render("two", {"--threads", "2"});
    ASSERT_EQ(two.size(), 4u);
    EXPECT_EQ(render("cached", {"--threads", "2"}), two);
    EXPECT_EQ(render("one", {"--threads", "1", "--no-cache"}), two);
    EXPECT_THAT(names("tmp"), IsEmpty());
    EXPECT_NE(render("other", {"--seed", "2"}), two);
}

TEST_F(Contract, EveryCommandHasHelpWithExamples) {
    for (const std::string command :
         {"replace", "render", "matte", "new", "region add", "region set", "region list", "apply",
          "info", "validate", "synth", "measure", "diff", "demo"}) {
        SCOPED_TRACE(command);
        Words words;
        std::istringstream stream(command);
        for (std::string word; stream >> word;)
            words.push_back(word);
        words.push_back("--help");
        const Outcome outcome = run(words);
        expect_success(outcome);
        EXPECT_THAT(outcome.err, IsEmpty());
        EXPECT_THAT(outcome.out, HasSubstr("Example"));
        EXPECT_THAT(outcome.out, HasSubstr("  weft " + command));
    }
    EXPECT_THAT(run({"--help"}).out, HasSubstr("Exit codes"));
}

TEST_F(Contract, UnknownOptionsAreUsageErrors) {
    for (const char* command : {"render", "matte", "synth", "diff"})
        expect_failure(run({command, "--no-such-option"}), 2,
                       {std::string("weft ") + command + " --help"});
}

}  // namespace
}  // namespace weft::test

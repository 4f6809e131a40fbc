// Output that cannot be written: detected before the work if possible, and never a partial file.
#include <unistd.h>

#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;

using BadOutput = CliTest;

TEST_F(BadOutput, FolderThatCannotBeMade) {
    make_shot(2);
    put("occupied", "a file");
    expect_failure(run_replace({"-o", "occupied/####.png"}), 3, {"occupied", "Choose another"});
    expect_failure(run_replace({"-o", "/proc/no-such/####.png"}), 3,
                   {"/proc/no-such", "Choose another"});
    EXPECT_EQ(bytes("occupied"), "a file");
}

TEST_F(BadOutput, FolderWithoutPermission) {
    if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
    make_shot(2);
    fs::create_directory(folder_ / "out");
    fs::permissions(folder_ / "out", fs::perms::owner_read | fs::perms::owner_exec);
    expect_failure(run_replace(), 3, {"out"});
    fs::permissions(folder_ / "out", fs::perms::owner_all);
    EXPECT_THAT(names("out"), IsEmpty());
}

// A file size limit simulates a full disk: writes fail half way.
class FullDisk : public CliTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(FullDisk, LeavesNoPartOfAFrame) {
    make_shot(2);
    run_replace({"-o", "elsewhere/####.png"});  // fills the analysis cache
    options_.largest_file_bytes = 8192;
    const std::string output = std::string("out/####") + GetParam();
    expect_failure(run_replace({"-o", output}), 6, {"Frame ", "out/000", GetParam()});
    EXPECT_THAT(names("out"), IsEmpty());
    EXPECT_THAT(names("tmp"), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Formats, FullDisk, ::testing::Values(".png", ".tif", ".exr"));

TEST_F(BadOutput, FullDiskKeepsTheOlderFrames) {
    make_shot(2);
    expect_success(run_replace());
    const auto before = contents("out");
    options_.largest_file_bytes = 8192;
    expect_failure(run_replace({"--overwrite"}), 6, {"out/000"});
    EXPECT_EQ(contents("out"), before);
}

TEST_F(BadOutput, FullDiskForTheMovieAndTheCache) {
    WEFT_NEEDS_MOVIES();
    make_shot(2);
    expect_success(run_replace());
    options_.largest_file_bytes = 8192;
    const Outcome movie = run_replace({"--skip-existing", "--movie", "review.mkv"});
    expect_failure(movie, 6, {"review.mkv"});
    EXPECT_FALSE(fs::exists(folder_ / "review.mkv"));
    options_.largest_file_bytes = 64;
    // Without progress, which also goes to a file and would hit the limit.
    const Outcome cache =
        run_replace({"-o", "new/####.png", "--cache", "cache", "--progress", "none"});
    EXPECT_EQ(cache.exit, 6) << cache.err;
    EXPECT_THAT(names("new"), IsEmpty());
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "cache"))
        EXPECT_FALSE(entry.is_regular_file() && entry.file_size() > 64) << entry.path();
}

TEST_F(BadOutput, ReportThatCannotBeWrittenStopsBeforeTheWork) {
    make_shot(2);
    expect_failure(run_replace({"--report", "tile.png/r.json"}), 3, {"tile.png"});
    EXPECT_THAT(names("out"), IsEmpty());
}

TEST_F(BadOutput, StandardOutputThatIsFull) {
    make_shot(1);
    options_.standard_output = "/dev/full";
    expect_failure(run({"diff", "frames/0001.png", "frames/0001.png", "--json"}), 6,
                   {"standard output"});
}

TEST_F(BadOutput, InputsAreNeverOverwritten) {
    make_shot(2);
    const auto frames = contents("frames"), masks = contents("masks");
    // Through another path to the plate.
    expect_failure(run_replace({"-o", "./tmp/../frames/####.png", "--overwrite"}), 2, {"input"});
    expect_failure(run_replace({"-o", "./masks/####.png", "--overwrite"}), 2, {"input"});
    expect_failure(run({"matte", "--plate", "frames/####.png", "--matte", "1=masks/0001.png", "-o",
                        "./masks/####.png", "--overwrite"}),
                   2, {"input"});
    EXPECT_EQ(contents("frames"), frames);
    EXPECT_EQ(contents("masks"), masks);
}

TEST_F(BadOutput, UnwritableCacheIsAWarningUnlessAskedFor) {
    make_shot(2);
    put("home/cache", "in the way");
    const Outcome outcome = run_replace();
    expect_success(outcome);
    expect_one_line(outcome.err, {"warning", "cache"});
    EXPECT_THAT(names("tmp"), IsEmpty());
    expect_failure(run_replace({"-o", "again/####.png", "--cache", "tile.png"}), 3,
                   {"tile.png", "--cache"});
}

}  // namespace
}  // namespace weft::test

// What a WriteRule lets happen at a path: files that exist, inputs, links, devices, the root.
#include "engine/media/write_rule.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "engine/media/atomic_file.h"
#include "tests/media/media_fixture.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class WriteRuleTest : public MediaTest {
  protected:
    void SetUp() override {
        MediaTest::SetUp();
        for (const char* folder : {"in", "out", "elsewhere"})
            fs::create_directory(folder_ / folder);
        put("in/a.0001.png", "input");
    }

    void put(const std::string& name, const std::string& text) const {
        std::ofstream(in(name), std::ios::binary) << text;
    }
    std::string text(const std::string& name) const {
        const auto bytes = bytes_of(in(name));
        return {bytes.begin(), bytes.end()};
    }
    // A rule that lets files be replaced, with a fence that `fill` fills.
    template <class Fill>
    static WriteRule fenced(const Fill& fill) {
        auto fence = std::make_shared<WriteFence>();
        fill(*fence);
        WriteRule rule;
        rule.existing = Existing::kReplace;
        rule.fence = fence;
        return rule;
    }
    Status write(const std::string& name, const WriteRule& rule) const {
        return write_file_atomically(in(name), std::string_view("new"), rule);
    }
    void expect_refused(const std::string& name, const WriteRule& rule,
                        const std::string& part) const {
        const Status status = write(name, rule);
        ASSERT_FALSE(status) << name;
        EXPECT_EQ(status.error().code, ErrorCode::kUsage) << status.error().text();
        EXPECT_THAT(status.error().sentence(), HasSubstr(part));
        EXPECT_THAT(status.error().sentence(), HasSubstr(in(name)));
    }
};

TEST_F(WriteRuleTest, WithoutOverwriteAFileThatIsThereStays) {
    put("out/a", "old");
    fs::create_symlink("nowhere", in("out/dangling"));
    expect_refused("out/a", {}, "run.overwrite");
    expect_refused("out/dangling", {}, "run.overwrite");
    EXPECT_EQ(text("out/a"), "old");
    EXPECT_TRUE(write("out/b", {}));
    EXPECT_EQ(text("out/b"), "new");
}

TEST_F(WriteRuleTest, AFileThatAppearsMeanwhileStays) {
    auto temporary = TemporaryFile::create(in("out/a"), {});
    ASSERT_TRUE(temporary);
    put("out/a", "of somebody else");
    EXPECT_EQ(temporary->commit().error().code, ErrorCode::kUsage);
    EXPECT_EQ(text("out/a"), "of somebody else");
}

TEST_F(WriteRuleTest, InputsAreKnownByWhateverNameLeadsToThem) {
    const WriteRule rule = fenced([&](WriteFence& fence) { fence.protect(in("in/a.0001.png")); });
    fs::create_hard_link(in("in/a.0001.png"), in("out/hard"));
    fs::create_symlink(in("in/a.0001.png"), in("out/soft"));
    fs::create_directory_symlink(in("in"), in("out/folder"));
    for (const char* name : {"in/a.0001.png", "out/../in/./a.0001.png", "out/hard", "out/soft",
                             "out/folder/a.0001.png"})
        expect_refused(name, rule, "input");
    EXPECT_EQ(text("in/a.0001.png"), "input");
    EXPECT_TRUE(write("in/b", rule));
}

TEST_F(WriteRuleTest, AnInputReadThroughALinkIsProtectedToo) {
    fs::create_symlink(in("in/a.0001.png"), in("in/link"));
    const WriteRule rule = fenced([&](WriteFence& fence) { fence.protect(in("in/link")); });
    expect_refused("in/a.0001.png", rule, "input");
    expect_refused("in/link", rule, "input");
}

TEST_F(WriteRuleTest, FramesOfAnInputPatternAreProtectedBeforeTheyExist) {
    const WriteRule rule = fenced([&](WriteFence& fence) {
        fence.protect_frames(SequencePattern::parse(in("in/a.####.png")).value());
    });
    expect_refused("in/a.0007.png", rule, "input");
    expect_refused("out/../in/a.0007.png", rule, "input");
    EXPECT_TRUE(write("in/a.7.png", rule));
    EXPECT_TRUE(write("out/a.0007.png", rule));
}

TEST_F(WriteRuleTest, ALinkIsReplacedAndItsTargetStays) {
    put("elsewhere/target", "old");
    fs::create_symlink(in("elsewhere/target"), in("out/link"));
    WriteRule rule;
    rule.existing = Existing::kReplace;
    EXPECT_TRUE(write("out/link", rule));
    EXPECT_FALSE(fs::is_symlink(in("out/link")));
    EXPECT_EQ(text("out/link"), "new");
    EXPECT_EQ(text("elsewhere/target"), "old");
}

TEST_F(WriteRuleTest, OnlyTheOpenedProjectIsSavedThroughItsLink) {
    put("elsewhere/target", "old");
    fs::create_symlink(in("elsewhere/target"), in("out/link"));
    WriteRule rule;
    rule.existing = Existing::kReplace;
    rule.follow_link = true;
    EXPECT_TRUE(write("out/link", rule));
    EXPECT_TRUE(fs::is_symlink(in("out/link")));
    EXPECT_EQ(text("elsewhere/target"), "new");
}

TEST_F(WriteRuleTest, NothingIsWrittenOutsideOfTheRoot) {
    const WriteRule rule =
        fenced([&](WriteFence& fence) { ASSERT_TRUE(fence.add_root(in("out"))); });
    fs::create_directory_symlink(in("elsewhere"), in("out/way_out"));
    for (const char* name :
         {"elsewhere/a", "out/../elsewhere/a", "out/way_out/a", "outside", "in/a.0001.png"})
        expect_refused(name, rule, "output root");
    EXPECT_TRUE(write("out/a", rule));
    ASSERT_TRUE(make_folder(in("out/deep/er"), rule));
    EXPECT_TRUE(write("out/deep/er/a", rule));
    for (const char* name : {"elsewhere/deep", "out/way_out/deep", "out/../deep"}) {
        const Status made = make_folder(in(name), rule);
        ASSERT_FALSE(made) << name;
        EXPECT_EQ(made.error().code, ErrorCode::kUsage);
    }
    EXPECT_TRUE(fs::is_empty(in("elsewhere")));
    EXPECT_FALSE(fs::exists(in("deep")));
}

TEST_F(WriteRuleTest, ALinkSwappedInMeanwhileChangesNothing) {
    const WriteRule rule =
        fenced([&](WriteFence& fence) { ASSERT_TRUE(fence.add_root(in("out"))); });
    fs::create_directory(in("out/sub"));
    auto temporary = TemporaryFile::create(in("out/sub/a"), rule);
    ASSERT_TRUE(temporary);
    fs::rename(in("out/sub"), in("out/moved"));
    fs::create_directory_symlink(in("elsewhere"), in("out/sub"));
    ASSERT_TRUE(temporary->write(std::as_bytes(std::span("new", 3))));
    EXPECT_TRUE(temporary->commit());
    EXPECT_TRUE(fs::is_empty(in("elsewhere")));
    EXPECT_EQ(text("out/moved/a"), "new");
}

TEST_F(WriteRuleTest, TheRootNeedNotExistButIsNoFile) {
    WriteFence fence;
    EXPECT_TRUE(fence.add_root(in("later")));
    EXPECT_EQ(fence.add_root(in("in/a.0001.png")).error().code, ErrorCode::kUsage);
}

TEST_F(WriteRuleTest, DevicesAndPipesOnlyWhereTheyAreAskedFor) {
    ASSERT_EQ(mkfifo(in("out/pipe").c_str(), 0600), 0);
    WriteRule rule;
    rule.existing = Existing::kReplace;
    expect_refused("out/pipe", rule, "pipe");
    rule.device = true;
    EXPECT_TRUE(write_file_atomically("/dev/null", std::string_view("x"), rule));
    struct stat status {};
    ASSERT_EQ(stat("/dev/null", &status), 0);
    EXPECT_TRUE(S_ISCHR(status.st_mode));
    EXPECT_EQ(write_file_atomically("/dev/full", std::string_view("x"), rule).error().code,
              ErrorCode::kNoSpace);
}

// As in `weft render --report /dev/fd/3 3>log`: what is behind the descriptor is written on.
TEST_F(WriteRuleTest, AFileBehindADescriptorIsWrittenOnNotReplaced) {
    const int file = ::open(in("out/log").c_str(), O_WRONLY | O_CREAT, 0600);
    ASSERT_GE(file, 0);
    ASSERT_EQ(::write(file, "before ", 7), 7);
    WriteRule rule;
    rule.device = true;
    EXPECT_TRUE(
        write_file_atomically("/dev/fd/" + std::to_string(file), std::string_view("new"), rule));
    ::close(file);
    EXPECT_EQ(text("out/log"), "before new");
}

TEST_F(WriteRuleTest, ARefusalLeavesNothingBehind) {
    put("out/a", "old");
    EXPECT_FALSE(write("out/a", {}));
    EXPECT_FALSE(check_output(in("out/a"), {}));
    EXPECT_TRUE(check_output(in("out/b"), {}));
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(in("out")))
        names.push_back(entry.path().filename().string());
    EXPECT_THAT(names, ElementsAre("a"));
}

}  // namespace
}  // namespace weft

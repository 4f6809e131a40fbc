// Inputs that are not regular files, that never end, or that belong to others: every command ends
// at once with one line.
#include <sys/stat.h>

#include <filesystem>

#include "tests/cli/cli_fixture.h"
#include "tests/support/places.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class Reading : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        // A command that blocks is killed, and the test fails by its exit code.
        options_.signal_after = std::chrono::seconds(20);
        options_.signal = 9;
        ASSERT_EQ(mkfifo(in("pipe").c_str(), 0600), 0);
        fs::create_directory(folder_ / "folder.json");
        put("sparse", "");
        fs::resize_file(folder_ / "sparse", std::uint64_t{3} << 30);
        put("secret", "root:$6$rounds=5000$salt$hash:19000::::::\nbin:*:19000::::::\n");
    }
    void make_project(const std::string& name = "card") {
        make_shot(2);
        expect_success(run({"new", "p.weft", "--plate", "frames/####.png", "-o", "out/####.png"}));
        expect_success(run({"region", "add", "p.weft", "--name", name, "--matte", "masks/####.png",
                            "--plane", "tile.png"}));
    }
    /// The commands that read a text file, with `file` in its place.
    static std::vector<Words> readers_of(const std::string& file) {
        return {{"render", file},
                {"info", file},
                {"validate", file},
                {"apply", "p.weft", file},
                {"look", "apply", file, "p.weft"},
                {"verify", file},
                {"task", file, "frames", "0"}};
    }
};

std::string line_of(const Words& words) {
    std::string out;
    for (const std::string& word : words)
        out += word + " ";
    return out;
}

TEST_F(Reading, NonRegularFilesAreRefusedAtOnce) {
    make_project();
    const std::pair<const char*, const char*> cases[]{{"/dev/zero", "a device, not a file"},
                                                      {"pipe", "a named pipe, not a file"},
                                                      {"folder.json", "a folder, not a file"},
                                                      {"sparse", "larger than"}};
    for (const auto& [file, reason] : cases) {
        for (const Words& words : readers_of(file)) {
            SCOPED_TRACE(line_of(words));
            expect_failure(run(words), 3, {file, reason});
        }
        SCOPED_TRACE(file);
        expect_failure(run_replace({"--track", file}), 3, {file, reason});
    }
}

TEST_F(Reading, ActionsMayComeFromAPipe) {
    make_project();
    put("take.json", R"([{"action": "rename_region", "region": "card", "name": "wall"}])");
    const std::string apply = " | '" + weft_program() + "' apply p.weft - 2>said";
    const std::string here = "cd '" + folder_.string() + "' && ";
    ASSERT_EQ(std::system((here + "cat take.json" + apply).c_str()), 0) << bytes("said");
    EXPECT_THAT(run({"region", "list", "p.weft"}).out, HasSubstr("wall"));
    const int status = std::system((here + "echo '[{'" + apply).c_str());
    EXPECT_EQ(WEXITSTATUS(status), 3);
    expect_one_line(bytes("said"), {"standard input"});
}

TEST_F(Reading, ImagesMustBeRegularFiles) {
    make_shot(2);
    for (const Words& texture : {Words{"--plane", "pipe"}, Words{"--texture", "pipe"}}) {
        SCOPED_TRACE(line_of(texture));
        Words words{"replace",        "--plate", "frames/####.png", "--matte",
                    "masks/####.png", "-o",      "out/####.png"};
        words.insert(words.end(), texture.begin(), texture.end());
        expect_failure(run(words), 3, {"pipe"});
    }
    expect_failure(run_replace({"--holdout", "pipe"}), 3, {"pipe"});
    fs::remove(folder_ / "frames/0002.png");
    ASSERT_EQ(mkfifo(in("frames/0002.png").c_str(), 0600), 0);
    expect_failure(run_replace(), 3, {"frames/0002.png", "a named pipe"});
    expect_failure(run({"synth", "pipe", "-o", "plane.png"}), 3, {"pipe", "a named pipe"});
    fs::rename(folder_ / "pipe", folder_ / "pipe.mov");
    expect_failure(run_replace({"--plate", "pipe.mov"}), 3, {"pipe.mov", "a named pipe"});
}

TEST_F(Reading, ForeignFilesAreNotQuoted) {
    make_project();
    for (const Words& words : readers_of("secret")) {
        SCOPED_TRACE(line_of(words));
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.exit, 3);
        expect_one_line(outcome.err, {"secret"});
        EXPECT_THAT(outcome.err, Not(HasSubstr("root")));
        EXPECT_THAT(outcome.err, Not(HasSubstr("salt")));
        EXPECT_THAT(outcome.err, Not(HasSubstr("json.")));
    }
    const Outcome track = run_replace({"--track", "secret"});
    EXPECT_EQ(track.exit, 3);
    EXPECT_THAT(track.err, Not(HasSubstr("root")));
}

TEST_F(Reading, ControlCharactersNeverReachTheTerminal) {
    const std::string name =
        "wall\x1b]0;owned\x07\x1b[2J\nweft: \xE2\x80\xAE"
        "ok\x7f";
    make_project(name);
    const auto safe = [](const std::string& text) {
        return std::none_of(text.begin(), text.end(),
                            [](char c) {
                                return (static_cast<unsigned char>(c) < 32 && c != '\n') ||
                                       c == 127;
                            }) &&
               text.find("\xE2\x80\xAE") == std::string::npos;
    };
    const Outcome list = run({"region", "list", "p.weft"});
    expect_success(list);
    EXPECT_TRUE(safe(list.out)) << list.out;
    EXPECT_EQ(std::count(list.out.begin(), list.out.end(), '\n'), 1) << list.out;
    EXPECT_THAT(list.out, HasSubstr("wall\\u001b]0;owned\\u0007"));

    const Outcome json = run({"region", "list", "p.weft", "--json"});
    expect_success(json);
    EXPECT_TRUE(safe(json.out)) << json.out;
    EXPECT_THAT(json.out, HasSubstr(R"(\u202eok\u007f)"));

    const Outcome error = run({"info", "no\x1b[31m.weft"});
    EXPECT_TRUE(safe(error.err)) << error.err;
    expect_one_line(error.err, {"no\\u001b[31m.weft"});
}

}  // namespace
}  // namespace weft::test

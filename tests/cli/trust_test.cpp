// An untrusted project must not write outside its folder.
#include <nlohmann/json.hpp>

#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using ::testing::IsEmpty;

class Trust : public CliTest {
  protected:
    // A received project: it is in inbox/ and writes to `output`.
    void receive(const std::string& output, const std::string& movie = {}) {
        if (!fs::exists(folder_ / "frames")) make_shot(2);
        fs::create_directories(folder_ / "inbox");
        if (!fs::exists(folder_ / "inbox/shot.weft")) {
            expect_success(run({"new", "inbox/shot.weft", "--plate", "../frames/####.png", "-o",
                                "out/####.png", "--quality", "draft"}));
            expect_success(run({"region", "add", "inbox/shot.weft", "--name", "card", "--matte",
                                "../masks/####.png", "--plane", "../tile.png"}));
        }
        Json shot = Json::parse(bytes("inbox/shot.weft"));
        shot["output"]["path"] = output;
        shot["output"]["movie"] = movie;
        put("inbox/shot.weft", shot.dump());
    }
    void expect_refused(const Words& arguments, const std::string& place = "elsewhere") {
        const std::string in_place = in(place);
        expect_failure(
            run(arguments), 7,
            {"inbox/shot.weft", "weft trust " + in("inbox"), "--output-root " + in_place});
        EXPECT_FALSE(fs::exists(folder_ / "elsewhere"));
    }
};

TEST_F(Trust, AProjectWritesInsideItsOwnFolder) {
    receive("out/####.png");
    expect_success(run({"render", "inbox/shot.weft"}));
    EXPECT_EQ(names("inbox/out").size(), 2u);
    EXPECT_FALSE(fs::exists(folder_ / "home/.config/weft"));
}

TEST_F(Trust, WritingOutsideIsRefusedUntilTrusted) {
    receive(in("elsewhere/####.png"));
    expect_refused({"render", "inbox/shot.weft"});
    expect_refused({"render", "inbox/shot.weft", "--dry-run"});
    expect_refused({"render", "inbox/shot.weft", "--overwrite", "--movie", "here.mkv"});
    expect_refused({"submit", "inbox/shot.weft", "--to", "slurm", "-o", "farm"});
    EXPECT_FALSE(fs::exists(folder_ / "farm"));
    expect_success(run({"trust", "inbox"}));
    expect_success(run({"render", "inbox/shot.weft"}));
    EXPECT_EQ(names("elsewhere").size(), 2u);
    fs::remove_all(folder_ / "elsewhere");
    expect_success(run({"trust", "--remove", "inbox"}));
    expect_refused({"render", "inbox/shot.weft"});
}

TEST_F(Trust, OtherPathsOutAreRefusedToo) {
    receive("../elsewhere/####.png");
    expect_refused({"render", "inbox/shot.weft"});
    receive("out/####.png", "../elsewhere/review.mkv");
    expect_refused({"render", "inbox/shot.weft"});
    fs::create_directory(folder_ / "target");
    fs::create_directory_symlink(folder_ / "target", folder_ / "inbox/link");
    receive("link/####.png");
    expect_refused({"render", "inbox/shot.weft"}, "target");
    EXPECT_THAT(names("target"), IsEmpty());
}

TEST_F(Trust, OutputsNamedByTheUserAreAllowed) {
    receive(in("elsewhere/####.png"));
    expect_success(run({"render", "inbox/shot.weft", "-o", "mine/####.png"}));
    EXPECT_EQ(names("mine").size(), 2u);
    // The same place, but given by the user.
    expect_success(run({"render", "inbox/shot.weft", "-o", in("elsewhere/####.png")}));
    expect_success(run({"render", "inbox/shot.weft", "--trust", "--overwrite"}));
    expect_success(
        run({"render", "inbox/shot.weft", "--output-root", in("elsewhere"), "--overwrite"}));
    expect_failure(run({"render", "inbox/shot.weft", "--output-root", "mine", "--overwrite"}), 2,
                   {"mine", "--output-root"});
    expect_success(
        run({"submit", "inbox/shot.weft", "--to", "slurm", "-o", "farm", "--trust", "--resume"}));
}

TEST_F(Trust, ProjectsCreatedHereAreTrusted) {
    make_shot(2);
    fs::create_directories(folder_ / "work/below");
    expect_success(run({"new", "work/shot.weft", "--plate", "../frames/####.png", "-o",
                        "../renders/####.png", "--quality", "draft"}));
    expect_success(run({"region", "add", "work/shot.weft", "--name", "card", "--matte",
                        "../masks/####.png", "--plane", "../tile.png"}));
    expect_success(run({"render", "work/shot.weft"}));
    const Json list = Json::parse(run({"trust", "--list", "--json"}).out);
    EXPECT_EQ(list["folders"], Json::array({{{"path", in("work")}, {"below", false}}}));
    // Its subfolders were not trusted.
    std::string text = bytes("work/shot.weft");
    text.replace(text.find("../renders"), 10, "../../renders");
    put("work/below/shot.weft", text);
    expect_failure(run({"render", "work/below/shot.weft"}), 7, {"weft trust " + in("work/below")});
    expect_success(run({"trust", "work"}));
    EXPECT_EQ(run({"trust", "--list"}).out, in("work") + "  with all folders below\n");
    // Now trusted; another error is reported.
    EXPECT_NE(run({"render", "work/below/shot.weft", "--overwrite"}).exit, 7);
}

TEST_F(Trust, DamagedListsTrustNothing) {
    receive(in("elsewhere/####.png"));
    for (const std::string rubbish :
         {"", "{", "[]", R"({"schema":"weft.trusted/1","folders":[1,{"path":2},{"path":"/"}]})",
          R"({"schema":"weft.trusted/1","folders":{"path":"/"}})"}) {
        SCOPED_TRACE(rubbish);
        fs::create_directories(folder_ / "home/.config/weft");
        put("home/.config/weft/trusted.json", rubbish);
        expect_refused({"render", "inbox/shot.weft"});
    }
    expect_success(run({"trust", "inbox"}));
    expect_success(run({"render", "inbox/shot.weft"}));
    options_.environment["HOME"] = "";
    expect_failure(run({"trust", "inbox"}), 3, {"HOME", "--trust"});
    expect_failure(run({"trust"}), 2, {"--list"});
    expect_failure(run({"trust", "inbox", "--list"}), 2, {"--list"});
    expect_failure(run({"trust", "no-such-folder"}), 3, {"no-such-folder"});
}

}  // namespace
}  // namespace weft::test

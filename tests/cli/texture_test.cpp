// Library textures in renders and projects: copied, credited, refused.
#include <nlohmann/json.hpp>

#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class LibraryTexture : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        make_shot(1);
        expect_success(run({"texture", "import", "sample.png", "--db", "lib.db", "--material",
                            "stone", "--author", "Ada", "--licence", "GPL-2+"}));
        const Outcome list = run({"texture", "list", "--db", "lib.db", "--json"});
        expect_success(list);
        id_ = Json::parse(list.out)["results"][0]["id"];
    }
    Words replace_with_texture(const Words& more) const {
        Words words{"replace",        "--plate",   "frames/####.png", "--matte",
                    "masks/####.png", "--texture", "db:" + id_,       "--db",
                    "lib.db",         "-o",        "out/####.png",    "--quality",
                    "draft",          "--report",  "report.json"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    void make_project(const Words& more = {}) {
        fs::create_directory(folder_ / "shots");
        Words words{"new", kProject,          "--plate",   "../frames/####.png",
                    "-o",  "../out/####.png", "--quality", "draft"};
        words.insert(words.end(), more.begin(), more.end());
        expect_success(run(words));
    }
    Outcome add_region() {
        return run({"region", "add", kProject, "--name", "card", "--matte", "../masks/####.png",
                    "--texture", "db:" + id_, "--db", "lib.db"});
    }
    static constexpr const char* kProject = "shots/shot.weft";
    std::string id_;
};

TEST_F(LibraryTexture, IsRenderedAndCreditedInTheReport) {
    expect_success(run(replace_with_texture({})));
    EXPECT_THAT(names("out"), ElementsAre("0001.png"));
    const Json used = Json::parse(bytes("report.json"))["textures"][0];
    EXPECT_EQ(used["library_id"], id_);
    EXPECT_EQ(used["author"], "Ada");
    EXPECT_EQ(used["licence"], "GPL-2+");
    EXPECT_THAT(used["source"].get<std::string>(), HasSubstr("sample.png"));
}

TEST_F(LibraryTexture, UnderAnExcludedLicenceIsRefused) {
    expect_failure(run(replace_with_texture({"--exclude-licences", "CC-BY,GPL"})), 7,
                   {"GPL-2+", "Ada", "GPL"});
    EXPECT_THAT(names("out"), IsEmpty());
    expect_success(run(replace_with_texture({"--exclude-licences", "CC-BY-SA"})));
    // An image of unknown licence, where that is excluded.
    expect_failure(run_replace({"--exclude-licences", "unknown", "-o", "other/####.png"}), 7,
                   {"unknown licence", "tile.png"});
}

TEST_F(LibraryTexture, IsCopiedBesideTheProject) {
    make_project();
    expect_success(add_region());
    EXPECT_THAT(names("shots/shot_textures"),
                ElementsAre("db_" + id_ + ".png", "db_" + id_ + ".png.credit.json"));
    const Json project = Json::parse(bytes(kProject));
    EXPECT_EQ(project["regions"][0]["texture"]["sample"], "shot_textures/db_" + id_ + ".png");

    fs::remove(folder_ / "lib.db");
    fs::rename(folder_ / "shots", folder_ / "moved");
    expect_success(run({"trust", "moved"}));
    expect_success(run({"render", "moved/shot.weft", "--report", "report.json"}));
    const Json used = Json::parse(bytes("report.json"))["textures"][0];
    EXPECT_EQ(used["licence"], "GPL-2+");
    EXPECT_EQ(used["library_id"], id_);
    // The same pixels as straight from the library.
    expect_failure(run({"render", "moved/shot.weft", "--overwrite", "--exclude-licences", "GPL"}),
                   7, {"GPL-2+"});
}

TEST_F(LibraryTexture, IsCopiedBySetAndApplyToo) {
    make_project();
    expect_success(run({"region", "add", kProject, "--name", "card", "--matte", "../masks/####.png",
                        "--texture", "../sample.png"}));
    expect_success(run({"region", "set", kProject, "card", "--texture", "db:" + id_.substr(0, 8),
                        "--db", "lib.db"}));
    EXPECT_THAT(bytes(kProject), HasSubstr("shot_textures/db_" + id_));
    fs::remove_all(folder_ / "shots/shot_textures");
    put("take.json", R"([{"action": "set_texture", "region": "card", "texture": {"sample": "db:)" +
                         id_ + "\"}}]");
    expect_success(run({"apply", kProject, "take.json", "--db", "lib.db"}));
    EXPECT_THAT(names("shots/shot_textures"), Contains("db_" + id_ + ".png"));
}

TEST_F(LibraryTexture, IsNotTakenIntoAProjectThatExcludesIt) {
    make_project({"--exclude-licences", "GPL"});
    const std::string before = bytes(kProject);
    expect_failure(add_region(), 7, {"GPL-2+", "card"});
    EXPECT_EQ(bytes(kProject), before);
    EXPECT_FALSE(fs::exists(folder_ / "shots/shot_textures"));
}

TEST_F(LibraryTexture, IsMarkedAndKept) {
    const std::string start = id_.substr(0, 8);
    expect_success(run({"texture", "mark", start, "--favourite", "--rating", "4", "--collect",
                        "walls", "--tags", "castle,old", "--db", "lib.db"}));
    expect_success(run(
        {"texture", "kept", "--save-search", "grey", "--words", "grey stone", "--db", "lib.db"}));
    const Outcome info = run({"texture", "info", id_, "--db", "lib.db", "--json"});
    expect_success(info);
    EXPECT_EQ(Json::parse(info.out)["rating"], 4);
    EXPECT_EQ(Json::parse(info.out)["favourite"], true);
    Outcome kept = run({"texture", "kept", "--db", "lib.db", "--json"});
    expect_success(kept);
    EXPECT_EQ(Json::parse(kept.out)["favourites"], 1);
    EXPECT_EQ(Json::parse(kept.out)["collections"]["walls"], 1);
    EXPECT_EQ(Json::parse(kept.out)["searches"]["grey"], "grey stone");
    const Outcome found = run({"texture", "search", "castle", "--collection", "walls", "--rating",
                               "4", "--db", "lib.db", "--json"});
    EXPECT_EQ(Json::parse(found.out)["total"], 1);

    // With one unknown id, the others are unchanged.
    expect_failure(
        run({"texture", "mark", id_, "ffffffffffff", "--no-favourite", "--db", "lib.db"}), 3,
        {"ffffffffffff"});
    expect_failure(run({"texture", "mark", id_, "--db", "lib.db"}), 2, {"--favourite"});
    expect_success(run({"texture", "mark", id_, "--uncollect", "walls", "--db", "lib.db"}));
    expect_success(run({"texture", "kept", "--delete-search", "grey", "--db", "lib.db"}));
    kept = run({"texture", "kept", "--db", "lib.db", "--json"});
    EXPECT_EQ(Json::parse(kept.out)["favourites"], 1);
    EXPECT_FALSE(Json::parse(kept.out)["collections"].contains("walls"));
    EXPECT_TRUE(Json::parse(kept.out)["searches"].empty());
}

TEST_F(LibraryTexture, NeedsATrainedDescriptorToCompare) {
    const Outcome found = run({"texture", "similar", "frames/0001.png", "--rectangle", "8,8,64,64",
                               "--db", "lib.db", "--json"});
    // One material is not enough to train the descriptor, and the message says so.
    EXPECT_EQ(found.exit, 0);
    EXPECT_TRUE(Json::parse(found.out)["results"].empty());
    EXPECT_THAT(found.err, HasSubstr("weft texture train"));
    expect_failure(run({"texture", "similar", "frames/0001.png", "--rectangle", "8,8,6400,64",
                        "--db", "lib.db"}),
                   2, {"rectangle"});
    expect_failure(run({"texture", "evaluate", "nowhere", "--db", "lib.db"}), 3, {"nowhere"});
}

}  // namespace
}  // namespace weft::test

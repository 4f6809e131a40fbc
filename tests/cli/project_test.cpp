// The same checks with a project file.
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A project in its own folder, so that its relative paths differ from the shell's.
class ProjectFile : public CliTest {
  protected:
    void make_project(int frames) {
        make_shot(frames);
        fs::create_directory(folder_ / "shots");
        expect_success(run({"new", kProject, "--plate", "../frames/####.png", "-o",
                            "../project/####.png", "--quality", "draft"}));
    }
    void add_card(const Words& more = {}) {
        Words words{
            "region",    "add",          kProject, "--name", "card", "--matte", "../masks/####.png",
            "--texture", "../sample.png"};
        words.insert(words.end(), more.begin(), more.end());
        expect_success(run(words));
    }
    static constexpr const char* kProject = "shots/shot.weft";
};

TEST_F(ProjectFile, GivesTheSameBytesAsReplace) {
    make_project(3);
    add_card({"--scale", "1.25"});
    expect_success(run({"render", kProject}));
    expect_success(
        run({"replace", "--plate", "frames/####.png", "--matte", "masks/####.png", "--texture",
             "sample.png", "-o", "out/####.png", "--quality", "draft", "--scale", "1.25"}));
    EXPECT_EQ(contents("project").size(), 3u);
    EXPECT_EQ(contents("project"), contents("out"));

    // Options of a run do not change the file, and their paths are relative to the shell's folder.
    const std::string before = bytes(kProject);
    expect_success(run({"render", kProject, "--frames", "2", "-o", "look/####.png"}));
    EXPECT_EQ(names("look"), (Words{"0002.png"}));
    EXPECT_EQ(bytes("look/0002.png"), bytes("out/0002.png"));
    EXPECT_EQ(bytes(kProject), before);
}

TEST_F(ProjectFile, SettingsAndActionsChangeIt) {
    make_project(1);
    add_card({"--scale", "2"});
    expect_success(run({"region", "set", kProject, "card", "--scale", "1.5", "--rotate", "10"}));
    EXPECT_THAT(bytes(kProject), HasSubstr("1.5"));
    const std::string before = bytes(kProject);
    put("retake.json",
        R"([{"action": "set_region_parameter", "region": "card", "key": "placement.scale", "value": 3.25},
            {"action": "rename_region", "region": "card", "name": "wall"}])");
    expect_success(run({"apply", kProject, "retake.json", "--dry-run"}));
    EXPECT_EQ(bytes(kProject), before);
    expect_success(run({"apply", kProject, "retake.json"}));
    EXPECT_THAT(bytes(kProject), HasSubstr("3.25"));

    const Outcome list = run({"region", "list", kProject, "--json"});
    expect_success(list);
    EXPECT_EQ(Json::parse(list.out)["regions"][0]["name"], "wall");
    const Outcome info = run({"info", kProject, "--json"});
    expect_success(info);
    const Json facts = Json::parse(info.out);
    EXPECT_EQ(facts["plate"]["size"], (Json{160, 120}));
    EXPECT_EQ(facts["regions"].size(), 1u);
    const Outcome valid = run({"validate", kProject});
    expect_success(valid);
    EXPECT_THAT(valid.out, HasSubstr("valid"));
    EXPECT_THAT(valid.err, IsEmpty());
}

TEST_F(ProjectFile, AFlagCanBeTurnedOff) {
    make_project(1);
    add_card();
    const auto enabled = [&] {
        const Outcome list = run({"region", "list", kProject, "--json"});
        return Json::parse(list.out)["regions"][0]["enabled"].get<bool>();
    };
    expect_success(run({"region", "set", kProject, "card", "--enabled=false"}));
    EXPECT_FALSE(enabled());
    expect_success(run({"region", "set", kProject, "card", "--scale", "2"}));
    EXPECT_FALSE(enabled()) << "a flag that was not given changes nothing";
    expect_success(run({"region", "set", kProject, "card", "--enabled"}));
    EXPECT_TRUE(enabled());
}

TEST_F(ProjectFile, ACorrectionIsSetAndRemoved) {
    make_project(1);
    add_card();
    const std::string before = bytes(kProject);
    expect_success(run({"region", "correct", kProject, "card", "3", "--pin", "60,50:64,50.5"}));
    EXPECT_THAT(bytes(kProject), HasSubstr("corrections"));
    EXPECT_THAT(bytes(kProject), HasSubstr("50.5"));
    expect_failure(run({"region", "correct", kProject, "card", "3", "--pin", "60,50"}), 2,
                   {"60,50", "x,y:x,y"});
    expect_success(run({"region", "correct", kProject, "card", "3"}));
    EXPECT_EQ(bytes(kProject), before);
}

TEST_F(ProjectFile, ARefusedChangeLeavesTheFile) {
    make_project(1);
    add_card();
    const std::string before = bytes(kProject);
    // The first action is good, the second is not: none is applied.
    put("half.json",
        R"([{"action": "rename_region", "region": "card", "name": "wall"},
            {"action": "set_region_parameter", "region": "wall", "key": "placement.scale", "value": -1}])");
    expect_failure(run({"apply", kProject, "half.json"}), 2, {"half.json", "--scale"});
    put("slip.json",
        R"([{"action": "rename_region", "region": "card", "name": "a", "nmae": "b"}])");
    expect_failure(run({"apply", kProject, "slip.json"}), 3, {"slip.json", "nmae"});
    expect_failure(run({"apply", kProject, "none.json"}), 3, {"none.json"});
    expect_failure(run({"region", "set", kProject, "roof", "--scale", "2"}), 2, {"roof"});
    expect_failure(run({"region", "set", kProject, "card", "--scale", "-2"}), 2, {"--scale"});
    expect_failure(run({"new", kProject, "--plate", "x.mp4"}), 2, {kProject, "--overwrite"});
    EXPECT_EQ(bytes(kProject), before);
    EXPECT_EQ(names("shots"), (Words{"shot.weft"}));
}

// Each in a process of its own, and all on one file.
TEST_F(ProjectFile, CommandsAtTheSameTimeLoseNothing) {
    make_project(1);
    add_card();
    constexpr int kWriters = 12;
    std::vector<std::thread> writers;
    std::vector<int> exits(kWriters, -1);
    for (int k = 0; k < kWriters; ++k)
        writers.emplace_back([&, k] {
            ProcessOptions own = options_;
            own.folder = folder_ / ("writer" + std::to_string(k));
            fs::create_directory(own.folder);
            const std::string name = "r" + std::to_string(k);
            const Words add{"region",       "add",     in(kProject),        "--name",
                            name,           "--matte", "../masks/####.png", "--texture",
                            "../sample.png"};
            const Words pin{"region",          "correct", in(kProject), "card",
                            std::to_string(k), "--pin",   "1,2:3,4"};
            exits[static_cast<std::size_t>(k)] = run_weft(k % 3 ? add : pin, own).exit;
        });
    for (std::thread& writer : writers)
        writer.join();
    EXPECT_THAT(exits, ::testing::Each(0));
    const Json project = Json::parse(bytes(kProject));
    EXPECT_EQ(project["regions"].size(), 9u);
    EXPECT_EQ(project["regions"][0]["corrections"].size(), 4u);
    EXPECT_EQ(names("shots"), (Words{"shot.weft"})) << "no lock and no temporary file stays";
}

TEST_F(ProjectFile, ValidateFindsWhatIsMissing) {
    make_project(2);
    EXPECT_EQ(run({"validate", kProject, "--no-files"}).exit, 2);  // no region yet
    add_card();
    fs::remove(folder_ / "masks/0002.png");
    expect_failure(run({"validate", kProject}), 4, {"card", "frame 2"});
    expect_success(run({"validate", kProject, "--no-files"}));
    fs::remove(folder_ / "sample.png");
    EXPECT_EQ(run({"validate", kProject}).exit == 0, false);
}

TEST_F(ProjectFile, ValidateFindsAMatteOfAnotherSize) {
    make_project(2);
    add_card();
    put_matte("masks/0002.png", Matte(Size{80, 60}, 255));
    expect_failure(run({"validate", kProject}), 3, {"0002.png", "80x60", "160x120"});
}

TEST_F(ProjectFile, RegionsAreLayersLaterOnesOnTop) {
    make_project(1);
    for (const char* colour : {"red", "blue"}) {
        ImageF3 flat(Size{64, 64});
        for (int i = 0; i < 64 * 64; ++i)
            flat.data()[3 * i + (*colour == 'r' ? 0 : 2)] = 0.8f;
        put_picture(std::string(colour) + ".png", flat);
    }
    Matte left = card_matte(0), all = card_matte(0);
    for (int y = 0; y < left.height(); ++y)
        for (int x = 70; x < left.width(); ++x)
            left.at(x, y) = 0;
    put_matte("left.png", left);
    put_matte("all.png", all);
    const auto add = [&](const char* name, const char* matte, const char* plane) {
        expect_success(run({"region", "add", kProject, "--name", name, "--matte", matte, "--plane",
                            plane, "--light", "none", "--match-plate", "0"}));
    };
    add("under", "../all.png", "../red.png");
    add("over", "../left.png", "../blue.png");
    expect_success(run({"render", kProject}));
    const ImageF3 result = picture("project/0001.png").rgb;
    EXPECT_NEAR(result.at(50, 50, 2), 0.8f, 0.01f);
    EXPECT_NEAR(result.at(50, 50, 0), 0.0f, 0.01f);
    EXPECT_NEAR(result.at(90, 50, 0), 0.8f, 0.01f);
    EXPECT_NEAR(result.at(90, 50, 2), 0.0f, 0.01f);
}

}  // namespace
}  // namespace weft::test

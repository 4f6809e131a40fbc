// --resume, --memory, and the recipe in frames that 'weft verify' checks.
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "engine/media/image_files.h"
#include "engine/media/metadata.h"
#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Resume : public CliTest {
  protected:
    // Rewrites a frame with one value of its recipe changed.
    void change_recipe(const std::string& name, const std::string& key, const std::string& text) {
        auto texts = read_recipe_metadata(in(name));
        ASSERT_FALSE(texts["weft:settings"].empty());
        texts[key] = text;
        WriteOptions options;
        options.metadata.assign(texts.begin(), texts.end());
        options.rule = WriteRule::own();
        const PlateFrame frame = picture(name);
        ASSERT_TRUE(write_image(in(name), frame.rgb, {}, options));
    }
};

TEST_F(Resume, KeepsFramesOfTheSameSettingsAndRendersTheOthersAgain) {
    make_shot(4);
    expect_success(run_replace({"--rotate", "10"}));
    const auto whole = contents("out");
    const auto third = fs::last_write_time(folder_ / "out/0003.png");
    fs::remove(folder_ / "out/0002.png");
    change_recipe("out/0004.png", "weft:settings", std::string(32, '0'));
    const Outcome resumed = run_replace({"--rotate", "10", "--resume", "--json"});
    expect_success(resumed);
    EXPECT_EQ(contents("out"), whole);
    EXPECT_EQ(fs::last_write_time(folder_ / "out/0003.png"), third);
    const Json frames = Json::parse(resumed.out)["frames"];
    for (int k = 0; k < 4; ++k)
        EXPECT_EQ(frames[k].value("skipped", false), k == 0 || k == 2) << k;

    // A change of settings affects every frame.
    const Outcome changed = run_replace({"--rotate", "20", "--resume", "--json"});
    expect_success(changed);
    EXPECT_FALSE(Json::parse(changed.out)["frames"][0].value("skipped", false));
    EXPECT_NE(contents("out"), whole);
}

TEST_F(Resume, AnotherBackendIsRefusedUnlessAllIsRenderedAgain) {
    make_shot(2);
    expect_success(run_replace());
    const auto whole = contents("out");
    change_recipe("out/0001.png", "weft:backend", "cuda");
    expect_failure(run_replace({"--resume"}), 2, {"cuda", "--backend cuda", "--restart"});
    expect_success(run_replace({"--restart"}));
    EXPECT_EQ(contents("out"), whole);
}

TEST_F(Resume, TheMovieOfAResumedRunIsThatOfAnUninterruptedOne) {
    WEFT_NEEDS_MOVIES();
    make_shot(4);
    expect_success(run_replace({"--movie", "whole.mp4", "-o", "whole/####.png"}));
    expect_success(run_replace({"--frames", "1-2"}));
    expect_success(run_replace({"--resume", "--movie", "resumed.mp4"}));
    EXPECT_EQ(bytes("resumed.mp4"), bytes("whole.mp4"));
}

TEST_F(Resume, EveryFormatCarriesTheRecipe) {
    make_shot(1);
    std::string inputs;
    for (const std::string extension : {"png", "tif", "jpg", "exr", "dpx"}) {
        const std::string pattern = extension + "/####." + extension;
        expect_success(run_replace({"-o", pattern, "--seed", "7"}));
        auto texts = read_recipe_metadata(in(extension + "/0001." + extension));
        EXPECT_EQ(texts["weft:settings"].size(), 32u) << extension;
        EXPECT_EQ(texts["weft:seed"], "7") << extension;
        EXPECT_THAT(texts["weft:inputs"], ::testing::StartsWith("plate:")) << extension;
        if (inputs.empty()) inputs = texts["weft:inputs"];
        EXPECT_EQ(texts["weft:inputs"], inputs) << extension;
        EXPECT_EQ(texts["weft:backend"], "cpu") << extension;
        expect_success(run_replace({"-o", pattern, "--seed", "7", "--resume"}));
        const auto once = contents(extension);
        expect_success(run_replace({"-o", pattern, "--seed", "7", "--overwrite"}));
        EXPECT_EQ(contents(extension), once) << extension;
    }
}

TEST_F(Resume, VerifyProvesARenderAndFindsWhatChanged) {
    make_shot(3);
    expect_success(run_replace({"--recipe", "shot.recipe.json"}));
    expect_success(run({"verify", "shot.recipe.json"}));
    const Outcome part = run({"verify", "shot.recipe.json", "--frames", "2", "--json"});
    expect_success(part);
    EXPECT_TRUE(Json::parse(part.out)["proved"]);
    EXPECT_EQ(Json::parse(part.out)["frames"], 1);

    const std::string frame = bytes("out/0002.png");
    put("out/0002.png", frame + "x");
    expect_failure(run({"verify", "shot.recipe.json"}), 8, {"out/0002.png", "not what it was"});
    put("out/0002.png", frame);
    expect_success(run({"verify", "shot.recipe.json", "--quick"}));

    // A plane that changed gives other pixels too.
    put_picture("tile.png", pattern_picture({128, 128}, 6));
    const Outcome changed = run({"verify", "shot.recipe.json"});
    EXPECT_EQ(changed.exit, 8);
    EXPECT_THAT(changed.err, HasSubstr("tile.png is not what it was"));
    EXPECT_THAT(changed.err, HasSubstr("frame 3 again gives other bytes"));
    EXPECT_THAT(names("tmp"), IsEmpty());

    put("rubbish.json", "{}");
    expect_failure(run({"verify", "rubbish.json"}), 3, {"rubbish.json", "weft.recipe/1"});
}

// Like a new delivery of the plate during a run.
// A graded plate is half as bright.
TEST_F(Resume, ALookUpTableOfTheColourConfigIsAnInput) {
    make_shot(2);
    const auto put_table = [&](const char* white) {
        put("graded.spi1d",
            "Version 1\nFrom 0 1\nLength 2\nComponents 1\n{\n0\n" + std::string(white) + "\n}\n");
    };
    put_table(".5");
    put("config.ocio", R"(ocio_profile_version: 2
strictparsing: true
roles: {default: raw, scene_linear: lin_rec709_srgb}
file_rules:
  - !<Rule> {name: Default, colorspace: default}
displays:
  screen:
    - !<View> {name: Raw, colorspace: raw}
colorspaces:
  - !<ColorSpace> {name: raw, isdata: true}
  - !<ColorSpace> {name: lin_rec709_srgb}
  - !<ColorSpace>
    name: graded
    to_scene_reference: !<FileTransform> {src: graded.spi1d, interpolation: linear}
)");
    options_.environment["OCIO"] = in("config.ocio");
    const Words words{"--plate-space", "graded", "--resume", "--json"};
    const auto skipped = [&](const Outcome& outcome) {
        expect_success(outcome);
        return Json::parse(outcome.out)["frames"][1].value("skipped", false);
    };
    EXPECT_FALSE(skipped(run_replace(words)));
    EXPECT_TRUE(skipped(run_replace(words)));
    put_table(".7");
    const Outcome again = run_replace(words);
    EXPECT_FALSE(skipped(again));
    EXPECT_THAT(again.err, HasSubstr("OpenColorIO config or its tables"));
    EXPECT_TRUE(skipped(run_replace(words)));
}

TEST_F(Resume, AnInputThatIsReplacedDuringTheRunIsAnError) {
    make_shot(12);
    put_picture("new.png", pattern_picture({160, 120}, 9));
    std::thread delivery([this] {
        for (int k = 0; k < 20000 && !fs::exists(folder_ / "out/0001.png"); ++k)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        std::error_code ignored;
        fs::rename(folder_ / "new.png", folder_ / "frames/0002.png", ignored);
    });
    const Outcome outcome = run_replace({"--threads", "1", "--report", "report.json", "--recipe",
                                         "recipe.json", "--progress", "none"});
    delivery.join();
    expect_failure(outcome, 3, {"frames/0002.png", "mixed", "--overwrite"});
    EXPECT_EQ(names("out").size(), 12u);
    EXPECT_EQ(Json::parse(bytes("report.json"))["changed_inputs"], (Words{in("frames/0002.png")}));
    EXPECT_FALSE(fs::exists(folder_ / "recipe.json"));
    expect_success(run_replace({"--overwrite", "--recipe", "recipe.json"}));
    expect_success(run({"verify", "recipe.json", "--quick"}));
}

TEST_F(Resume, MemoryLimitsHowManyFramesAreWorkedOnAndSaysWhenNoneFits) {
    make_shot(4);
    expect_success(run_replace({"-o", "free/####.png", "--threads", "4"}));
    expect_success(run_replace({"-o", "bound/####.png", "--threads", "4", "--memory", "500M"}));
    EXPECT_EQ(contents("bound"), contents("free"));
    expect_failure(run_replace({"-o", "none/####.png", "--memory", "100M"}), 6,
                   {"--memory", "160x120"});
    expect_failure(run_replace({"--memory", "lots"}), 2, {"lots"});
}

TEST_F(Resume, FoldersOfKilledRunsAreRemoved) {
    make_shot(6);
    options_.signal_when = folder_ / "out/0001.png";
    options_.signal = SIGKILL;
    EXPECT_EQ(run_replace({"--no-cache", "--threads", "1"}).exit, 128 + SIGKILL);
    options_.signal = 0;
    expect_success(run_replace({"--no-cache", "--resume"}));
    EXPECT_THAT(names("tmp"), IsEmpty());
    EXPECT_EQ(names("out").size(), 6u);
}

// A step with this plate takes longer than the allowed two seconds.
TEST_F(Resume, TerminatesInTimeInTheMiddleOfAStep) {
    const Size size{3000, 2000};
    const ImageF3 plate = pattern_picture(size, 9);
    fs::create_directories(folder_ / "big");
    put_picture("big/1.png", plate);
    put_picture("big/2.png", plate);
    put_matte("big_matte.png", Matte(size, 255));
    options_.signal_after = std::chrono::milliseconds(1200);
    options_.signal = SIGTERM;
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome =
        run({"replace", "--plate", "big/#.png", "--matte", "big_matte.png", "--plane", "tile.png",
             "-o", "out/#.png", "--threads", "1", "--no-cache", "--backend", "cpu"});
    const auto after = std::chrono::steady_clock::now() - start - options_.signal_after;
    EXPECT_EQ(outcome.exit, 143) << outcome.err;
    // Sanitizers slow down the exit too.
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
    EXPECT_LT(after, std::chrono::milliseconds(6000));
#else
    EXPECT_LT(after, std::chrono::milliseconds(2000));
#endif
    EXPECT_THAT(names("tmp"), IsEmpty());
    EXPECT_THAT(names("out"), IsEmpty());
}

}  // namespace
}  // namespace weft::test

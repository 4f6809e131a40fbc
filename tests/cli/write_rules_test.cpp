// The write rules for every command: never over an input, never over another file without
// --overwrite, never through a link, never outside --output-root.
#include <nlohmann/json.hpp>

#include "engine/media/image_files.h"
#include "engine/media/metadata.h"
#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class WriteRules : public CliTest {
  protected:
    // All files in the shot's folder except `but`, by their bytes.
    std::map<std::string, std::string> all_but(const std::vector<std::string>& but) const {
        std::map<std::string, std::string> out;
        for (auto at = fs::recursive_directory_iterator(folder_);
             at != fs::recursive_directory_iterator(); ++at) {
            const std::string name = at->path().lexically_relative(folder_).string();
            const bool left_out = name.starts_with("home") || name.starts_with("tmp") ||
                                  std::any_of(but.begin(), but.end(), [&](const std::string& b) {
                                      return name.starts_with(b);
                                  });
            if (at->is_regular_file() && !left_out) out[name] = bytes(name);
        }
        return out;
    }
    // A project of the shot: shot.weft.
    void make_project(const Words& more = {}) {
        make_shot(2);
        expect_success(run({"new", "shot.weft", "--plate", "frames/####.png", "-o", "out/####.png",
                            "--quality", "draft"}));
        Words region{"region",         "add",     "shot.weft", "--name", "card", "--matte",
                     "masks/####.png", "--plane", "tile.png"};
        region.insert(region.end(), more.begin(), more.end());
        expect_success(run(region));
    }
};

TEST_F(WriteRules, ReportRecipeAndMovieAreNeverWrittenOverAnInput) {
    make_project();
    const auto before = all_but({"out"});
    for (const char* victim : {"frames/0001.png", "masks/0002.png", "tile.png", "shot.weft",
                               "./tmp/../frames/0002.png"}) {
        for (const char* flag : {"--report", "--recipe"}) {
            expect_failure(run({"render", "shot.weft", flag, victim, "--overwrite"}), 2,
                           {victim, "input"});
            expect_failure(run({"render", "shot.weft", flag, victim}), 2, {victim, "input"});
        }
    }
    fs::create_hard_link(folder_ / "tile.png", folder_ / "linked.json");
    expect_failure(run({"render", "shot.weft", "--report", "linked.json", "--overwrite"}), 2,
                   {"linked.json", "input"});
    fs::remove(folder_ / "linked.json");
    EXPECT_EQ(all_but({"out"}), before);
    EXPECT_THAT(names("out"), IsEmpty());
}

TEST_F(WriteRules, TexturesAndPassesAreInputsToo) {
    make_shot(2);
    fs::create_directories(folder_ / "textures");
    fs::copy_file(folder_ / "tile.png", folder_ / "textures/0001.png");
    fs::copy_file(folder_ / "sample.png", folder_ / "textures/0002.png");
    fs::create_directories(folder_ / "ink");
    for (const char* name : {"ink/0001.png", "ink/0002.png"})
        put_matte(name, Matte(Card::kPlate, 0));
    const auto before = all_but({"out"});
    expect_failure(
        run_replace({"--plane", "textures/0001.png", "-o", "textures/####.png", "--overwrite"}), 2,
        {"textures/0001.png", "input"});
    expect_failure(run({"replace", "--plate", "frames/####.png", "--matte", "masks/####.png",
                        "--texture", "sample.png", "--texture-also", "textures/0002.png", "-o",
                        "textures/####.png", "--overwrite", "--backend", "cpu"}),
                   2, {"textures/0002.png", "input"});
    expect_failure(run_replace({"--lines", "ink/####.png", "-o", "ink/####.png", "--overwrite"}), 2,
                   {"ink/", "input"});
    expect_failure(run({"synth", "sample.png", "-o", "sample.png", "--overwrite"}), 2,
                   {"sample.png", "input"});
    expect_failure(run({"synth", "sample.png", "-o", "a.png", "--source-map", "a.png"}), 2,
                   {"The plane and the source map", "a.png"});
    EXPECT_EQ(all_but({"out"}), before);
}

TEST_F(WriteRules, ExistingFilesNeedOverwrite) {
    WEFT_NEEDS_MOVIES();
    make_project();
    put("r.json", "notes");
    for (const char* flag : {"--report", "--recipe", "--movie"}) {
        const std::string name = std::string(flag) == "--movie" ? "r.mp4" : "r.json";
        put(name, "notes");
        expect_failure(run({"render", "shot.weft", flag, name}), 2, {name, "--overwrite"});
        EXPECT_EQ(bytes(name), "notes");
        EXPECT_THAT(names("out"), IsEmpty()) << "it is known before the work";
    }
    expect_success(run({"render", "shot.weft", "--report", "r.json", "--overwrite"}));
    EXPECT_EQ(Json::parse(bytes("r.json"))["schema"], "weft.report/1");

    expect_success(run({"look", "save", "shot.weft", "a.look.json"}));
    expect_failure(run({"look", "save", "shot.weft", "a.look.json"}), 2,
                   {"a.look.json", "--overwrite"});
    expect_success(run({"look", "save", "shot.weft", "a.look.json", "--overwrite"}));
    const std::string project = bytes("shot.weft"), tile = bytes("tile.png");
    for (const char* victim : {"shot.weft", "tile.png"})
        expect_failure(run({"look", "save", "shot.weft", victim, "--overwrite"}), 2,
                       {victim, "input"});
    EXPECT_EQ(bytes("shot.weft"), project);
    EXPECT_EQ(bytes("tile.png"), tile);
}

TEST_F(WriteRules, AResumedRunReplacesItsOwnReportOnly) {
    make_project();
    const Words first{"render", "shot.weft", "--report", "r.json", "--recipe", "a/b/recipe.json"};
    expect_success(run(first));
    EXPECT_EQ(Json::parse(bytes("a/b/recipe.json"))["schema"], "weft.recipe/1");
    for (const char* flag : {"--resume", "--skip-existing"}) {
        Words again = first;
        again.emplace_back(flag);
        expect_success(run(again));
        put("notes.json", R"({"title": "\"schema\": \"weft.report/1\""})");
        again[3] = "notes.json";
        expect_failure(run(again), 2, {"notes.json", "--overwrite"});
        EXPECT_THAT(bytes("notes.json"), HasSubstr("title"));
    }
}

TEST_F(WriteRules, AResumedRunReplacesItsOwnMovieOnly) {
    WEFT_NEEDS_MOVIES();
    make_shot(2);
    expect_success(run_replace({"--movie", "a.mp4"}));
    const std::string movie = bytes("a.mp4");
    expect_success(run_replace({"--movie", "a.mp4", "--resume"}));
    EXPECT_EQ(bytes("a.mp4"), movie);
    put("a.mp4", "notes");
    expect_failure(run_replace({"--movie", "a.mp4", "--resume"}), 2, {"a.mp4", "--overwrite"});
    EXPECT_EQ(bytes("a.mp4"), "notes");
}

TEST_F(WriteRules, ResumeRefusesFramesOfOtherPrograms) {
    make_shot(2);
    fs::create_directories(folder_ / "out");
    put_picture("out/0002.png", pattern_picture({64, 48}, 3));
    const auto before = contents("out");
    for (const char* flag : {"--resume", "--skip-existing"}) {
        expect_failure(run_replace({flag}), 2, {"out/0002.png", "not rendered by Weft"});
        EXPECT_EQ(contents("out"), before);
    }
    expect_success(run_replace({"--overwrite"}));
    const auto frames = contents("out");
    // Weft's files with other settings do not stop the run.
    expect_success(run_replace({"--resume", "--rotate", "5"}));
    EXPECT_NE(contents("out"), frames);
}

TEST_F(WriteRules, ALinkInTheOutputFolderIsReplaced) {
    make_shot(2);
    fs::create_directories(folder_ / "out");
    put("precious.png", "precious");
    fs::create_symlink(folder_ / "precious.png", folder_ / "out/0001.png");
    fs::create_symlink(folder_ / "nowhere.png", folder_ / "out/0002.png");
    expect_failure(run_replace(), 2, {"out/0001.png", "exists already"});
    expect_success(run_replace({"--overwrite"}));
    EXPECT_EQ(bytes("precious.png"), "precious");
    EXPECT_FALSE(fs::exists(folder_ / "nowhere.png"));
    for (const char* name : {"out/0001.png", "out/0002.png"}) {
        EXPECT_FALSE(fs::is_symlink(folder_ / name));
        EXPECT_EQ(picture(name).rgb.size(), Card::kPlate);
    }
}

TEST_F(WriteRules, AProjectIsSavedThroughTheLinkThatItIsOpenedBy) {
    make_project();
    fs::rename(folder_ / "shot.weft", folder_ / "real.weft");
    fs::create_symlink("real.weft", folder_ / "shot.weft");
    expect_success(run({"region", "set", "shot.weft", "card", "--rotate", "7"}));
    EXPECT_TRUE(fs::is_symlink(folder_ / "shot.weft"));
    EXPECT_THAT(bytes("real.weft"), HasSubstr("\"rotate_deg\""));
}

TEST_F(WriteRules, TwoOutputsAreNeverOneFile) {
    WEFT_NEEDS_MOVIES();
    make_shot(2);
    expect_failure(run_replace({"--movie", "a.mp4", "--report", "./a.mp4"}), 2,
                   {"movie", "report", "a.mp4"});
    expect_failure(run_replace({"--recipe", "a.json", "--report", "tmp/../a.json"}), 2,
                   {"report", "recipe", "a.json"});
    expect_failure(run_replace({"--report", "out/0002.png"}), 2, {"Frame 2", "report"});
    expect_failure(run_replace({"-o", "out/a.0001.exr", "--frames", "1", "--layers", "all",
                                "--layers-output", "out/a.####.exr"}),
                   2, {"Frame 1 and the layers", "out/a.0001.exr"});
    EXPECT_THAT(names("out"), IsEmpty());
}

TEST_F(WriteRules, LayersWithTheFramesPatternGoIntoTheFrames) {
    make_shot(2);
    expect_success(run_replace({"-o", "apart/####.exr", "--layers", "all"}));
    expect_success(run_replace(
        {"-o", "one/####.exr", "--layers", "all", "--layers-output", "./one/%04d.exr"}));
    EXPECT_EQ(contents("one"), contents("apart"));
    expect_failure(
        run_replace({"-o", "two/####.png", "--layers", "all", "--layers-output", "two/####.png"}),
        2, {"two/####.png"});
}

TEST_F(WriteRules, NothingIsWrittenOutsideOfTheOutputRoot) {
    WEFT_NEEDS_MOVIES();
    make_project();
    fs::create_directories(folder_ / "root");
    fs::create_directories(folder_ / "elsewhere");
    fs::create_directory_symlink(folder_ / "elsewhere", folder_ / "root/way_out");
    const Words render{"render", "shot.weft", "--output-root", "root"};
    const auto with = [&](const Words& more) {
        Words words = render;
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    const auto before = all_but({});
    expect_failure(with({}), 2, {"out/0001.png", "output root"});
    expect_failure(with({"-o", "root/way_out/####.png"}), 2, {"output root"});
    expect_failure(with({"-o", "root/../elsewhere/new/####.png"}), 2, {"output root"});
    expect_failure(with({"-o", "root/####.png", "--movie", "a.mp4"}), 2, {"a.mp4", "output root"});
    expect_failure(with({"-o", "root/####.png", "--report", "a.json"}), 2,
                   {"a.json", "output root"});
    expect_failure(with({"-o", "root/####.png", "--recipe", "new/a.json"}), 2,
                   {"new", "output root"});
    expect_failure(
        with({"-o", "root/####.png", "--layers", "all", "--layers-output", "elsewhere/####.exr"}),
        2, {"elsewhere", "output root"});
    expect_failure(run({"look", "save", "shot.weft", "a.json", "--output-root", "root"}), 2,
                   {"a.json", "output root"});
    expect_failure(run({"collect", "shot.weft", "elsewhere/c", "--output-root", "root"}), 2,
                   {"elsewhere/c", "output root"});
    expect_failure(run({"submit", "shot.weft", "--to", "slurm", "-o", "elsewhere/job",
                        "--output-root", "root"}),
                   2, {"output root"});
    expect_failure(run({"synth", "sample.png", "-o", "a.png", "--output-root", "root"}), 2,
                   {"a.png", "output root"});
    EXPECT_EQ(all_but({}), before);
    EXPECT_TRUE(fs::is_empty(folder_ / "elsewhere"));
    expect_success(with({"-o", "root/new/####.png", "--movie", "root/a.mp4", "--report",
                         "root/a.json", "--recipe", "root/b/a.json"}));
    EXPECT_EQ(names("root/new").size(), 2u);
}

TEST_F(WriteRules, AReportMayGoToStandardOutput) {
    make_shot(1);
    const Outcome outcome = run_replace({"--report", "/dev/stdout", "--progress", "none"});
    expect_success(outcome);
    EXPECT_EQ(Json::parse(outcome.out)["schema"], "weft.report/1");
    expect_failure(run_replace({"-o", "again/####.png", "--movie", "/dev/stdout"}), 2, {});
}

TEST_F(CliTest, NewReplacesAProjectAndNothingElse) {
    make_shot(1);
    const std::string plate = bytes("frames/0001.png");
    const Words words{"new", "frames/0001.png", "--plate", "frames/####.png", "-o", "x/####.png"};
    expect_failure(run(with_options(words, {"--overwrite"})), 2, {"frames/0001.png"});
    EXPECT_EQ(bytes("frames/0001.png"), plate);
    put("notes.weft", "precious");
    expect_failure(run({"new", "notes.weft", "--plate", "frames/####.png", "--overwrite"}), 2,
                   {"notes.weft", "Choose another name"});
    EXPECT_EQ(bytes("notes.weft"), "precious");
    expect_success(run({"new", "sub/shot.weft", "--plate", "../frames/####.png"}));
    expect_success(run({"new", "sub/shot.weft", "--plate", "../frames/####.png", "--overwrite"}));
}

TEST_F(CliTest, AStudyIsNotWrittenAmongItsFrames) {
    make_shot(2);
    const auto before = contents("frames");
    expect_failure(run({"study", "--plate", "frames/####.png", "--matte", "masks/####.png",
                        "--texture", "sample.png", "-o", "frames", "--methods", "still"}),
                   2, {"frames", "Choose another folder"});
    EXPECT_EQ(contents("frames"), before);
}

}  // namespace
}  // namespace weft::test

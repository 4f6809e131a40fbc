// A shot split into farm tasks; looks and collected projects.
#include <sys/stat.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_fixture.h"
#include "tests/cli/openjd_schema.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

class Farm : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        WEFT_NEEDS_MOVIES();
    }
    // A shot with a synthesized texture, estimated motion and a movie.
    void make_project() {
        make_shot(7);
        expect_success(run({"new", "shot.weft", "--plate", "frames/####.png", "-o", "out/####.png",
                            "--movie", "out.mkv", "--quality", "draft"}));
        expect_success(run({"region", "add", "shot.weft", "--name", "card", "--matte",
                            "masks/####.png", "--texture", "sample.png", "--refine", "0"}));
    }
    Json submitted(const std::string& engine) {
        const Outcome outcome = run({"submit", "shot.weft", "--to", engine, "-o", "farm", "--chunk",
                                     "3", "--threads", "1", "--json", "--overwrite"});
        expect_success(outcome);
        return outcome.exit == 0 ? Json::parse(outcome.out)["files"] : Json();
    }
    int task(const std::string& stage, int index) {
        return run({"task", "farm/job.json", stage, std::to_string(index), "--progress", "none"})
            .exit;
    }
};

TEST_F(Farm, TasksGiveTheBytesOfOneMachine) {
    make_project();
    submitted("slurm");
    const Json job = Json::parse(bytes("farm/job.json"));
    Words stages;
    for (const Json& stage : job["stages"])
        stages.push_back(stage["name"]);
    EXPECT_EQ(stages, (Words{"motion", "analyse", "planes", "frames", "encode"}));
    for (const Json& stage : job["stages"]) {
        // In reverse order, and the first one twice, as a farm may run them.
        const int count = static_cast<int>(stage["frames"].size());
        for (int k = count - 1; k >= 0; --k)
            ASSERT_EQ(task(stage["name"], k), 0) << stage["name"] << k;
        ASSERT_EQ(task(stage["name"], 0), 0) << stage["name"];
    }
    const auto by_tasks = contents("out");
    const std::string movie = bytes("out.mkv");
    ASSERT_EQ(by_tasks.size(), 7u);
    expect_success(run({"render", "shot.weft", "--restart", "--no-cache", "--backend", "cpu"}));
    EXPECT_EQ(contents("out"), by_tasks);
    EXPECT_EQ(bytes("out.mkv"), movie);
    EXPECT_EQ(task("frames", 3), 2);
    EXPECT_EQ(task("paint", 0), 2);
}

// All frames of a job have the same settings, even if the project changes.
TEST_F(Farm, TasksRenderTheProjectThatWasSubmitted) {
    make_project();
    expect_success(run({"render", "shot.weft", "--no-cache", "--backend", "cpu"}));
    const auto whole = contents("out");
    fs::remove_all(folder_ / "out");
    fs::remove(folder_ / "out.mkv");
    submitted("slurm");
    for (const char* stage : {"motion", "analyse", "planes"}) {
        for (int k = 0; k < (std::string(stage) == "motion" ? 3 : 1); ++k)
            ASSERT_EQ(task(stage, k), 0) << stage << k;
    }
    ASSERT_EQ(task("frames", 0), 0);
    expect_success(run({"region", "set", "shot.weft", "card", "--rotate", "33"}));
    ASSERT_EQ(task("frames", 1), 0);
    fs::remove(folder_ / "shot.weft");
    ASSERT_EQ(task("frames", 2), 0);
    EXPECT_EQ(contents("out"), whole);
}

TEST_F(Farm, ATaskRefusesWhatWasNotSubmitted) {
    make_project();
    submitted("slurm");
    const std::string name =
        Json::parse(bytes("farm/job.json"))["snapshot"]["file"].get<std::string>();
    const std::string snapshot = bytes("farm/" + name), sample = bytes("sample.png");
    std::string changed = snapshot;
    changed.replace(changed.find("\"draft\""), 7, "\"final\"");
    put("farm/" + name, changed);
    expect_failure(run({"task", "farm/job.json", "frames", "0", "--progress", "none"}), 3,
                   {name, "Submit again"});
    put("farm/" + name, snapshot);
    fs::copy_file(folder_ / "tile.png", folder_ / "sample.png",
                  fs::copy_options::overwrite_existing);
    expect_failure(run({"task", "farm/job.json", "planes", "0", "--progress", "none"}), 3,
                   {"texture", "Submit again"});
    put("sample.png", sample);
    const std::string matte = bytes("masks/0005.png");
    put("masks/0005.png", bytes("masks/0001.png"));
    expect_failure(run({"task", "farm/job.json", "planes", "0", "--progress", "none"}), 3,
                   {"the mattes", "Submit again"});
    put("masks/0005.png", matte);
    EXPECT_EQ(task("planes", 0), 0);
    fs::remove(folder_ / "farm" / name);
    expect_failure(run({"task", "farm/job.json", "frames", "0", "--progress", "none"}), 3,
                   {name, "Submit again"});
    EXPECT_FALSE(fs::exists(folder_ / "out/0001.png"));
}

TEST_F(Farm, SubmitRefusesWhatRenderRefuses) {
    make_project();
    const auto refused = [&](const std::string& name, int exit, const Words& parts) {
        SCOPED_TRACE(name);
        expect_failure(run({"render", "shot.weft"}), exit, parts);
        expect_failure(run({"submit", "shot.weft", "--to", "slurm", "-o", "farm_" + name}), exit,
                       parts);
        EXPECT_FALSE(fs::exists(folder_ / ("farm_" + name)));
    };
    const std::string good = bytes("shot.weft");
    const auto with = [&](const std::function<void(Json&)>& edit) {
        Json shot = Json::parse(good);
        edit(shot);
        put("shot.weft", shot.dump());
    };
    with([](Json& shot) { shot["regions"] = Json::array(); });
    refused("regions", 2, {"no region"});
    with([](Json& shot) { shot["output"]["path"] = "out/####.xyz"; });
    refused("format", 2, {"xyz"});
    with([](Json& shot) { shot["output"]["path"] = ""; });
    refused("output", 2, {"No output"});
    with([](Json& shot) { shot["output"]["path"] = "one.png"; });
    refused("number", 2, {"one.png", "frame number"});
    with([](Json& shot) { shot["output"]["path"] = "frames/####.png"; });
    refused("input", 2, {"input"});
    put("shot.weft", good);
    fs::create_directories(folder_ / "out");
    put("out/0003.png", "there already");
    refused("existing", 2, {"out/0003.png", "--resume"});
    fs::remove(folder_ / "out/0003.png");
    fs::rename(folder_ / "masks/0005.png", folder_ / "five.png");
    refused("matte", 4, {"masks/####.png", "5"});
    fs::rename(folder_ / "five.png", folder_ / "masks/0005.png");
    fs::remove(folder_ / "sample.png");
    refused("texture", 3, {"sample.png"});
}

TEST_F(Farm, AnotherJobsFolderIsLeftAlone) {
    make_project();
    submitted("slurm");
    const auto before = contents("farm");
    expect_success(run({"region", "set", "shot.weft", "card", "--rotate", "33"}));
    expect_failure(run({"submit", "shot.weft", "--to", "slurm", "-o", "farm"}), 2,
                   {"job.json", "--resume"});
    EXPECT_EQ(contents("farm"), before);
    expect_success(run({"submit", "shot.weft", "--to", "slurm", "-o", "farm", "--resume"}));
    EXPECT_EQ(Json::parse(bytes("farm/job.json"))["existing"], "resume");
    expect_success(run({"submit", "shot.weft", "--to", "slurm", "-o", "farm", "--overwrite"}));
    EXPECT_EQ(Json::parse(bytes("farm/job.json"))["existing"], "overwrite");
    // A file of that name that is not a job is not replaced.
    fs::create_directory(folder_ / "mine");
    put("mine/job.json", "{}");
    expect_failure(run({"submit", "shot.weft", "--to", "slurm", "-o", "mine", "--resume"}), 2,
                   {"job.json"});
    EXPECT_EQ(bytes("mine/job.json"), "{}");
}

TEST_F(Farm, TasksWriteBelowTheJobsRootsOnly) {
    make_project();
    submitted("slurm");
    Json job = Json::parse(bytes("farm/job.json"));
    ASSERT_FALSE(job["output_roots"].empty());
    for (const Json& root : job["output_roots"])
        EXPECT_THAT(root.get<std::string>(), ::testing::StartsWith(folder_.string()));
    job["output_roots"] = Words{in("another")};
    put("farm/job.json", job.dump());
    expect_failure(run({"task", "farm/job.json", "planes", "0", "--progress", "none"}), 2,
                   {"another"});
    EXPECT_FALSE(fs::exists(folder_ / "out/0001.png"));
    job["output_roots"] = Words();
    put("farm/job.json", job.dump());
    expect_failure(run({"task", "farm/job.json", "planes", "0", "--progress", "none"}), 3,
                   {"job.json"});
}

TEST_F(Farm, EncodingWaitsForAllFrames) {
    make_project();
    submitted("slurm");
    EXPECT_EQ(task("encode", 0), 4);
}

TEST_F(Farm, OpenJdTemplatesHaveTheFormOfTheSpecification) {
    make_project();
    submitted("openjd");
    const Json job = Json::parse(bytes("farm/template.json"));
    EXPECT_EQ(job["specificationVersion"], "jobtemplate-2023-09");
    EXPECT_LE(job["name"].get<std::string>().size(), 128u);
    EXPECT_EQ(job["steps"][3]["dependencies"][0]["dependsOn"], "planes");
    const Json& space = job["steps"][3]["parameterSpace"]["taskParameterDefinitions"][0];
    EXPECT_EQ(space["type"], "INT");
    EXPECT_EQ(space["range"], "0-2");
    const Json& action = job["steps"][3]["script"]["actions"]["onRun"];
    EXPECT_EQ(action["command"], "{{Param.Weft}}");
    EXPECT_EQ(action["args"][3], "{{Task.Param.Index}}");
    EXPECT_EQ(action["cancelation"]["mode"], "NOTIFY_THEN_TERMINATE");
    EXPECT_EQ(openjd_violations(job), Words());
    Json bad = job;
    bad["steps"][0]["script"]["actions"]["onRun"]["args"][1] = "{{Param.Jbo}}";
    bad["steps"][1]["dependencies"][0]["dependsOn"] = "frames";
    bad["owner"] = "me";
    EXPECT_EQ(openjd_violations(bad).size(), 3u);
    ASSERT_EQ(task("motion", 0), 0);
    const Outcome told = run({"task", "farm/job.json", "analyse", "0", "--progress", "openjd"});
    EXPECT_THAT(told.out, HasSubstr("openjd_progress: 100.0\n"));
    EXPECT_THAT(told.out, HasSubstr("openjd_status: analyse frame "));
    fs::remove(folder_ / "frames/0003.png");
    EXPECT_THAT(run({"task", "farm/job.json", "frames", "0", "--progress", "openjd"}).out,
                HasSubstr("openjd_fail: "));
}

// The schema allows 1024 tasks per step.
TEST_F(Farm, OpenJdRefusesMoreTasksThanTheSchemaAllows) {
    make_project();
    Json shot = Json::parse(bytes("shot.weft"));
    shot["plate"]["missing"] = "hold";
    shot["settings"]["frames"] = "1-1500";
    put("shot.weft", shot.dump());
    expect_failure(run({"submit", "shot.weft", "--to", "openjd", "-o", "farm_1", "--chunk", "1"}),
                   2, {"1024", "--chunk 2"});
    expect_success(run({"submit", "shot.weft", "--to", "openjd", "-o", "farm_2", "--chunk", "2"}));
    EXPECT_EQ(openjd_violations(Json::parse(bytes("farm_2/template.json"))), Words());
}

TEST_F(Farm, ScriptsContainNoNames) {
    make_project();
    fs::rename(folder_ / "shot.weft", folder_ / "x'; touch hacked; '.weft");
    for (const std::string engine : {"slurm", "openjd", "flamenco", "deadline", "opencue"}) {
        const Outcome outcome =
            run({"submit", "x'; touch hacked; '.weft", "--to", engine, "-o", "farm_" + engine});
        expect_success(outcome);
        for (const std::string& name : names("farm_" + engine)) {
            if (name == "job.json" || name == "cache") continue;
            EXPECT_THAT(bytes("farm_" + engine + "/" + name), Not(HasSubstr("hacked;"))) << name;
        }
    }
    EXPECT_EQ(run({"submit", "x'; touch hacked; '.weft", "--to", "opencue", "-o", "a'b"}).exit, 2);
    EXPECT_EQ(run({"submit", "x'; touch hacked; '.weft", "--to", "spreadsheet", "-o", "f"}).exit,
              2);
}

TEST_F(Farm, RootsAreMapped) {
    make_project();
    fs::rename(folder_ / "frames", folder_ / "plates");
    std::string text = bytes("shot.weft");
    text.replace(text.find("frames/####.png"), 15, "/nowhere/else/####.png");
    put("shot.weft", text);
    EXPECT_EQ(run({"render", "shot.weft"}).exit, 4);
    expect_success(run({"render", "shot.weft", "--map", "/nowhere/else=" + in("plates")}));
    EXPECT_EQ(run({"render", "shot.weft", "--map", "/nowhere"}).exit, 2);
}

TEST_F(Farm, ALookIsAppliedToAnotherShot) {
    make_project();
    expect_success(run({"region", "set", "shot.weft", "card", "--rotate", "33", "--light-strength",
                        "0.25", "--temporal", "paper"}));
    expect_success(run({"look", "save", "shot.weft", "card.look.json"}));
    fs::create_directories(folder_ / "b");
    expect_success(
        run({"new", "b/other.weft", "--plate", "../frames/####.png", "-o", "o/####.png"}));
    expect_success(run({"region", "add", "b/other.weft", "--name", "wall", "--matte",
                        "../masks/####.png", "--plane", "../tile.png"}));
    expect_success(run({"look", "apply", "card.look.json", "b/other.weft"}));
    const Json region = Json::parse(bytes("b/other.weft"))["regions"][0];
    EXPECT_EQ(region["placement"]["rotate_deg"], 33.0);
    EXPECT_EQ(region["light"]["strength"], 0.25);
    EXPECT_EQ(region["temporal"]["mode"], "paper");
    EXPECT_EQ(region["matte"]["files"], "../masks/####.png");
    EXPECT_FALSE(region["texture"].contains("plane"));
    EXPECT_TRUE(fs::exists(fs::path(region["texture"]["sample"].get<std::string>())));
    expect_success(run({"region", "add", "b/other.weft", "--name", "floor", "--matte",
                        "../masks/####.png", "--plane", "../tile.png"}));
    EXPECT_EQ(run({"look", "apply", "card.look.json", "b/other.weft"}).exit, 2);
    expect_success(run({"look", "apply", "card.look.json", "b/other.weft", "--region", "floor"}));
}

TEST_F(Farm, ACollectedProjectRendersTheSameElsewhere) {
    make_project();
    expect_success(run({"render", "shot.weft"}));
    // A path with ".." must not lead the copy out of the folder.
    std::string text = bytes("shot.weft");
    text.replace(text.find("\"sample.png\""), 12,
                 "\"../" + folder_.filename().string() + "/sample.png\"");
    put("shot.weft", text);
    expect_success(run({"collect", "shot.weft", "kept/here"}));
    for (const char* gone : {"frames", "masks"})
        fs::remove_all(folder_ / gone);
    fs::remove(folder_ / "sample.png");
    EXPECT_EQ(names("kept"), (Words{"here"}));
    EXPECT_THAT(bytes("kept/here/shot.weft"), Not(HasSubstr("..")));
    expect_success(run({"render", "kept/here/shot.weft"}));
    EXPECT_EQ(bytes("kept/here/out/out.mkv"), bytes("out.mkv"));
    fs::remove(folder_ / "kept/here/out/out.mkv");
    EXPECT_EQ(contents("kept/here/out"), contents("out"));
    EXPECT_EQ(run({"collect", "shot.weft", "kept/here"}).exit, 2);
}

TEST_F(Farm, VersionAndDoctorListWhatIsAvailable) {
    EXPECT_THAT(run({"--version"}).out, HasSubstr("backends: cpu"));
    const Outcome doctor = run({"doctor", "--json"});
    expect_success(doctor);
    bool cuda = false;
    for (const Json& finding : Json::parse(doctor.out)["findings"])
        cuda = cuda || (finding["what"] == "backend cuda" && finding["available"]);
    // Missing parts are not "ok" and have a reason.
    const std::string told = run({"doctor"}).out;
    EXPECT_THAT(told, HasSubstr(cuda ? "ok   backend cuda: "
                                     : "--   backend cuda: not available: CUDA cannot be used"));
    EXPECT_THAT(told, Not(HasSubstr("--backend auto")));
}

}  // namespace
}  // namespace weft::test

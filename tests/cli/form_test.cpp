// weft form, and what a render's report says of the form.
#include <nlohmann/json.hpp>

#include "tests/cli/cli_fixture.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class FormCommand : public CliTest {
  protected:
    static inline const std::string kPlane = "plane:50,40,90,40,105,75,35,75";

    Outcome form(const Words& more = {}) const {
        Words words{"form",      "--plate", "frames/####.png", "--matte", "masks/####.png",
                    "--quality", "draft"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
};

TEST_F(FormCommand, PrintsALineForEachRegion) {
    make_shot(3);
    const Outcome outcome = form({"--progress", "none", "--form-shape", kPlane});
    expect_success(outcome);
    EXPECT_THAT(outcome.out, StartsWith("region: plane, as drawn, tilted "));
    EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1);
    EXPECT_FALSE(fs::exists(in("out")));
    EXPECT_EQ(form({"--progress", "none", "--form", "flat"}).out, "region: flat, as chosen\n");
}

TEST_F(FormCommand, JsonAndTheReportOfARenderSayTheSame) {
    make_shot(3);
    const Outcome outcome = form({"--json", "--form-shape", kPlane});
    expect_success(outcome);
    const Json found = Json::parse(outcome.out);
    EXPECT_EQ(found["schema"], "weft.forms/1");
    EXPECT_EQ(found["exit_code"], 0);
    ASSERT_EQ(found["forms"].size(), 1u);
    const Json& region = found["forms"][0];
    EXPECT_EQ(region["source"], "shape");
    EXPECT_EQ(region["drawn"], "plane");
    EXPECT_EQ(region["plane"], true);
    EXPECT_GT(region["tilt_deg"], 1.0);
    EXPECT_GT(region["fov_deg"], 1.0);
    const Outcome rendered =
        run_replace({"--json", "--frames", "2", "--progress", "none", "--form-shape", kPlane});
    expect_success(rendered);
    EXPECT_EQ(Json::parse(rendered.out)["forms"], found["forms"]);
}

// All that a render would refuse of a shape is known before the analysis.
TEST_F(FormCommand, AShapeBesideItsRegionIsRefusedBeforeTheAnalysis) {
    make_shot(3);
    const Outcome outcome =
        run_replace({"--progress", "plain", "--form-shape", "ball:2,2,2", "--cache", "private"});
    expect_failure(outcome, 2, {"does not lie on the region", "--form-shape"});
    EXPECT_THAT(outcome.err, ::testing::Not(HasSubstr("analys")));
    EXPECT_FALSE(fs::exists(in("out/0001.png")));
    // Hashes of the files that were read, and no analysis.
    for (const auto& kept : fs::directory_iterator(in("private")))
        EXPECT_EQ(kept.path().filename(), "fingerprints");
}

TEST_F(FormCommand, TakesAProject) {
    make_shot(3);
    expect_success(run({"new", "shot.weft", "--plate", "frames/####.png"}));
    expect_failure(run({"form", "shot.weft"}), 2, {"no region"});
    for (const char* name : {"wall", "floor\x1b[31m"})
        expect_success(run({"region", "add", "shot.weft", "--name", name, "--matte",
                            "masks/####.png", "--texture", "not_there.png", "--form", "flat"}));
    const Outcome outcome = run({"form", "shot.weft"});
    expect_success(outcome);
    EXPECT_EQ(outcome.out, "wall: flat, as chosen\nfloor\\u001b[31m: flat, as chosen\n");
    expect_failure(run({"form", "shot.weft", "--fov", "47"}), 2, {"shot.weft", "region set"});
}

TEST_F(FormCommand, BadInputIsAnErrorThatSaysWhatToDo) {
    make_shot(3);
    expect_failure(run({"form"}), 2, {"No plate", "--plate"});
    expect_failure(run({"form", "gone.weft"}), 3, {"gone.weft"});
    expect_failure(form({"--form-shape", "ball:900,900,20"}), 2, {"--form-shape"});
    expect_failure(form({"--form", "depth"}), 2, {"--depth-pass"});
    expect_failure(form({"--position-pass", "frames/p.####.exr"}), 4, {"p.####.exr"});
}

}  // namespace
}  // namespace weft::test

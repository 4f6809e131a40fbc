#include "bench/study/study.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <nlohmann/json.hpp>

#include "bench/study/study_pictures.h"
#include "bench/study/study_report.h"
#include "bench/study/svg_chart.h"
#include "engine/media/image_files.h"
#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class StudyTest : public ShotTest {
  protected:
    void SetUp() override {
        ShotTest::SetUp();
        FlowField motion(Card::kPlate);
        for (int y = 0; y < motion.d.height(); ++y) {
            for (int x = 0; x < motion.d.width(); ++x) {
                motion.d.at(x, y, 0) = Card::kStepX;
                motion.d.at(x, y, 1) = Card::kStepY;
            }
        }
        std::filesystem::create_directory(folder_ / "flow");
        for (int step = 0; step + 1 < kFrames; ++step) {
            ASSERT_TRUE(
                write_flow_kitti(in("flow/000" + std::to_string(step + 1) + ".png"), motion));
        }
    }

    StudyOptions options() const {
        StudyOptions out;
        out.project = spec("unused").project;
        out.project.output.path.clear();
        out.project.regions.front() = out.project.regions.front().with([&](Region& r) {
            r.motion.files = in("flow/####.png");
            r.texture.sample = in("tile.png");
            r.texture.plane.clear();
        });
        out.folder = in("study");
        out.threads = 2;
        return out;
    }

    std::string text(const std::string& name) const {
        std::ifstream file(in("study/" + name), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
};

TEST_F(StudyTest, RendersMeasuresAndReportsEveryMethod) {
    StudyOptions study = options();
    study.alphas = {0.5};
    const auto result = run_study(study, {}, {});
    ASSERT_TRUE(result) << result.error().text();
    std::vector<std::string> ids;
    for (const StudyRun& run : result->runs) {
        ids.push_back(run.id);
        EXPECT_EQ(run.measured.frames.size(), 6u) << run.id;
        EXPECT_TRUE(above_floor(run.measured.all).has_value()) << run.id;
    }
    EXPECT_THAT(
        ids, testing::ElementsAre("anew", "patchmatch", "poisson", "still", "paper-0.5", "locked",
                                  "light-statistics", "light-histogram", "light-literal",
                                  "finished", "full", "no-graphcut", "no-time"));
    // Light and reflectance of the plate and of the result, on every key frame.
    ASSERT_EQ(result->light_strip.size(), 6u);
    for (const StripRow& row : result->light_strip)
        EXPECT_EQ(row.pictures.size(), result->strip_frames.size()) << row.title;
    // The card moves by whole pixels: a texture that goes with it hardly changes, one that stands
    // still or is made anew does.
    EXPECT_LT(result->find("locked")->measured.all.tde.mean, 2.0);
    EXPECT_GT(result->find("still")->measured.all.tde.mean, 8.0);
    EXPECT_GT(result->find("anew")->measured.all.tde.mean, 8.0);
    // Poisson's tile goes with the region's box, which here is the card's own motion.
    EXPECT_EQ(result->verdict.baseline_id, "poisson");
    std::vector<StudyRun> others = result->runs;
    std::erase_if(others, [](const StudyRun& run) { return run.id == "poisson"; });
    const StudyVerdict verdict = study_verdict(others);
    ASSERT_TRUE(verdict.reduction_percent);
    EXPECT_GT(*verdict.reduction_percent, 80);
    EXPECT_FALSE(result->estimated_ideal);

    const std::string html = text("report.html");
    EXPECT_EQ(html, study_html(*result));
    EXPECT_THAT(html, HasSubstr("Surface-locked"));
    EXPECT_THAT(html, HasSubstr("data:image/jpeg;base64,"));
    for (const char* outside : {"http:", "https:", "<script", "<link", "@import"})
        EXPECT_THAT(html, Not(HasSubstr(outside)));
    const auto json = nlohmann::json::parse(text("report.json"));
    EXPECT_EQ(json.at("runs").size(), 13u);
    EXPECT_EQ(json.at("verdict").at("best_baseline"), result->verdict.baseline_id);
    const std::string csv = text("report.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 13 * 6);
    EXPECT_EQ(result->worst.size(), 6u);
}

TEST_F(StudyTest, MeasuresWithAnEstimateWhereThereIsNoTrueMotion) {
    StudyOptions study = options();
    study.methods = {"still"};
    study.project.settings.frames = "2-4";
    study.project.regions.front() =
        study.project.regions.front().with([](Region& r) { r.motion = MotionSource{}; });
    const auto result = run_study(study, {}, {});
    ASSERT_TRUE(result) << result.error().text();
    EXPECT_TRUE(result->estimated_ideal);
    ASSERT_EQ(result->runs.size(), 2u);
    EXPECT_EQ(result->runs[1].measured.all.motion, "deepflow");
    EXPECT_TRUE(result->verdict.reduction_percent.has_value());
}

TEST_F(StudyTest, GoesOnWithTheSameFrames) {
    StudyOptions study = options();
    study.methods = {"patchmatch", "poisson"};
    study.project.settings.frames = "1-3";
    study.threads = 1;
    ASSERT_TRUE(run_study(study, {}, {}));
    const auto one = contents("study/frames/patchmatch"), cloned = contents("study/frames/poisson");
    const auto again = run_study(study, {}, {});
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().code, ErrorCode::kUsage);
    study.overwrite = true;
    study.threads = 3;
    ASSERT_TRUE(run_study(study, {}, {}));
    EXPECT_EQ(contents("study/frames/patchmatch"), one);
    EXPECT_EQ(contents("study/frames/poisson"), cloned);
    EXPECT_EQ(one.size(), 3u);
}

TEST_F(StudyTest, RefusesWhatItCannotStudy) {
    StudyOptions study = options();
    study.methods = {"magic"};
    const auto unknown = run_study(study, {}, {});
    ASSERT_FALSE(unknown);
    EXPECT_THAT(unknown.error().text(), HasSubstr("'magic'"));
    study = options();
    study.project.settings.frames = "1,3";
    const auto gaps = run_study(study, {}, {});
    ASSERT_FALSE(gaps);
    EXPECT_EQ(gaps.error().code, ErrorCode::kUsage);
    CancelToken cancel;
    cancel.cancel(130);
    const auto stopped = run_study(options(), cancel, {});
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::kInterrupted);
}

StudyRun run_of(const std::string& id, StudyRole role, double above, double sharpness = 1,
                double alpha = 0) {
    StudyRun run;
    run.id = id;
    run.role = role;
    run.alpha = alpha;
    run.measured.all.tde_floor.add(2.0);
    run.measured.all.tde_at_floor.add(2.0 + above);
    run.measured.all.sharpness_kept.add(sharpness);
    return run;
}

TEST(StudyVerdictTest, TakesTheBestBaselineAndTheSharpPaperOfTheSmallestAlpha) {
    const StudyVerdict v = study_verdict(
        {run_of("anew", StudyRole::kBaseline, 30), run_of("still", StudyRole::kBaseline, 8),
         run_of("p1", StudyRole::kPaper, 20, 0.97, 1),
         run_of("p8", StudyRole::kPaper, 16, 0.91, 0.8),
         run_of("p2", StudyRole::kPaper, 1, 0.4, 0.2), run_of("locked", StudyRole::kLocked, 0.4),
         run_of("full", StudyRole::kAblation, 0.1)});
    EXPECT_EQ(v.baseline_id, "still");
    EXPECT_NEAR(*v.reduction_percent, 95, 1e-9);
    EXPECT_EQ(v.paper_id, "p8");
    EXPECT_NEAR(*v.paper_reduction_percent, 97.5, 1e-9);
    EXPECT_NEAR(*v.floor, 2, 1e-9);
}

TEST(StudyVerdictTest, SaysNothingWithoutAFloor) {
    StudyRun locked;
    locked.role = StudyRole::kLocked;
    const StudyVerdict v = study_verdict({locked});
    EXPECT_FALSE(v.reduction_percent || v.paper_reduction_percent || v.floor);
}

TEST(DataUri, IsBase64) {
    const auto of = [](const std::string& s) {
        return data_uri({s.begin(), s.end()}).substr(std::string("data:image/jpeg;base64,").size());
    };
    EXPECT_EQ(of(""), "");
    EXPECT_EQ(of("f"), "Zg==");
    EXPECT_EQ(of("fo"), "Zm8=");
    EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

TEST(SvgChart, BreaksALineWhereNothingWasMeasured) {
    LineChart chart{"a < b", "x", "y", true, std::nullopt, {}};
    chart.lines.push_back({"one & two",
                           "red",
                           false,
                           false,
                           {{1, 2.0}, {2, 3.0}, {3, std::nullopt}, {4, 0.0}, {5, 5.0}}});
    const std::string svg = svg_of(chart);
    EXPECT_THAT(svg, HasSubstr("a &lt; b"));
    EXPECT_THAT(svg, HasSubstr("one &amp; two"));
    const auto d = svg.find(" d=\"");
    ASSERT_NE(d, std::string::npos);
    const std::string path = svg.substr(d, svg.find('"', d + 4) - d);
    EXPECT_EQ(std::count(path.begin(), path.end(), 'M'), 2);
    EXPECT_EQ(std::count(path.begin(), path.end(), 'L'), 1);
    EXPECT_THAT(svg, HasSubstr("<circle"));
}

TEST(SvgChart, SaysWhenThereIsNothingToShow) {
    EXPECT_THAT(svg_of(LineChart{"t", "x", "y", false, std::nullopt, {}}),
                HasSubstr("Not measured"));
}

}  // namespace
}  // namespace weft::test

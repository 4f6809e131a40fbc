// What is said of the form that was found, and the job that finds it without rendering.
#include "app/render/form_report.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/render/form_job.h"
#include "tests/render/shot_fixture.h"

namespace weft::test {
namespace {

using testing::HasSubstr;
using Source = FormFinding::Source;

FormReport found(Source source, bool plane, int frames, float belief, float tilt, float error,
                 float fov) {
    FormReport form;
    form.region = "Floor";
    form.frame = 12;
    form.finding = {source, plane, frames, belief, tilt, error, fov};
    return form;
}

TEST(FormText, SaysWhatShowedItAndHowSureItIs) {
    EXPECT_EQ(form_text(found(Source::kMotion, true, 38, 1, 71.2f, 2.1f, 46.8f)),
              "plane, from 38 frames of motion, tilted 71° ± 2°, field of view 47°");
    EXPECT_EQ(form_text(found(Source::kMotion, false, 11, 0.93f, 12, 0.32f, 50)),
              "curved surface, from 11 frames of motion, tilted 12° ± 0.3° in the middle, field of "
              "view 50°, believed to 93 %");
    FormReport form = found(Source::kShape, false, 1, 1, 5, 0, 49);
    form.drawn = FormGuideKind::kCylinder;
    form.amount = 0.5f;
    EXPECT_EQ(form_text(form), "cylinder, as drawn, field of view 49°, amount 0.5");
    form = found(Source::kShape, true, 1, 1, 63.6f, 4, 49);
    form.drawn = FormGuideKind::kParallel;
    EXPECT_EQ(form_text(form), "plane, from parallel strokes, tilted 64° ± 4°, field of view 49°");
    form = found(Source::kPass, false, 1, 1, 0, 0, 0);
    form.pass = "the depth pass";
    EXPECT_EQ(form_text(form), "as the depth pass shows it on 1 frame");
}

TEST(FormText, SaysHowSureTheLensIsAndWhoFoundIt) {
    FormReport form = found(Source::kMotion, true, 11, 1, 71.2f, 2.1f, 46.8f);
    form.finding.fov_error_deg = 2.2f;
    EXPECT_EQ(form_text(form),
              "plane, from 11 frames of motion, tilted 71° ± 2°, field of view 47° ± 2°");
    form.finding.fov_regions = 3;
    EXPECT_THAT(form_text(form), testing::EndsWith("field of view 47° ± 2° by 3 regions"));
    EXPECT_EQ(form_json(form)["fov_regions"], 3);
    EXPECT_NEAR(form_json(form)["fov_error_deg"].get<double>(), 2.2, 1e-6);
    EXPECT_EQ(form_text(found(Source::kOutline, false, 1, 1, 0, 0, 0)),
              "round, inflated from its outline");
}

TEST(FormText, SaysOnWhichFrameLinesShowIt) {
    const FormReport form = found(Source::kLines, true, 1, 0.93f, 68, 2, 54);
    EXPECT_EQ(
        form_text(form),
        "plane, from straight lines on frame 12, tilted 68° ± 2°, field of view 54°, believed "
        "to 93 %");
    EXPECT_EQ(form_json(form)["source"], "lines");
    EXPECT_EQ(form_json(form)["plane"], true);
}

TEST(FormText, SaysWhyASurfaceIsFlat) {
    FormReport form = found(Source::kNone, true, 1, 0, 0, 0, 0);
    EXPECT_EQ(
        form_text(form),
        "flat, because too few frames show it for motion to tell its form, and its lines show "
        "no plane");
    form = found(Source::kNone, true, 11, 0, 0, 0, 0);
    EXPECT_EQ(form_text(form),
              "flat, because its motion is not that of a rigid thing, and its lines show no plane");
    form.finding.no_parallax = true;
    EXPECT_EQ(form_text(form),
              "flat, because the camera only turns or zooms, and its lines show no plane; draw its "
              "form by hand");
    EXPECT_EQ(form_json(form)["reason"], "no_parallax");
    form.lines_asked = false;
    EXPECT_EQ(form_text(form),
              "flat, because the camera only turns or zooms; draw its form by hand");
    form = found(Source::kNone, true, 11, 0.4f, 30, 24, 47);
    EXPECT_EQ(form_text(form), "flat, because neither motion nor lines tell its form well enough");
    form.not_sought = FormReport::NotSought::kCorners;
    EXPECT_EQ(form_text(form), "flat, because its corners give the perspective");
    form = found(Source::kMotion, true, 11, 1, 71, 2, 47);
    form.amount = 0;
    EXPECT_EQ(form_text(form), "flat, because its amount is 0");
}

TEST(FormJson, HasTheFiguresOfTheText) {
    const auto motion = form_json(found(Source::kMotion, true, 38, 0.9f, 71.25f, 2, 47));
    EXPECT_EQ(motion.dump(),
              R"({"region":"Floor","reference_frame":12,"source":"motion",)"
              R"("text":"plane, from 38 frames of motion, tilted 71° ± 2°, field of view 47°, )"
              R"(believed to 90 %","amount":1.0,"plane":true,"frames":38,"tilt_deg":71.25,)"
              R"("tilt_error_deg":2.0,"fov_deg":47.0,"belief":0.9})");
    const auto flat = form_json(found(Source::kNone, false, 0, 0, 0, 0, 0));
    EXPECT_EQ(flat["source"], "flat");
    EXPECT_EQ(flat["reason"], "few_frames");
    EXPECT_FALSE(flat.contains("plane") || flat.contains("tilt_deg"));
    EXPECT_FALSE(form_json(found(Source::kPass, false, 12, 1, 0, 0, 0)).contains("plane"))
        << "nobody has looked whether a pass shows a plane";
}

class FormJob : public ShotTest {
  protected:
    static std::string text_of(const JobSpec& job, int* steps = nullptr) {
        const auto result = run_form_job(job, {}, [&](const ProgressEvent&) {
            if (steps) ++*steps;
        });
        if (!result) return result.error().text();
        EXPECT_EQ(result->forms.size(), 1u);
        return result->forms.front().region + ": " + form_text(result->forms.front());
    }
    static JobSpec with(const JobSpec& job, const std::function<void(Region&)>& change) {
        JobSpec out = job;
        out.project.regions.front() = job.project.regions.front().with(change);
        return out;
    }
};

TEST_F(FormJob, FindsWhatARenderFindsAndRendersNothing) {
    const JobSpec job = spec("out");
    int steps = 0;
    const std::string text = text_of(job, &steps);
    EXPECT_GT(steps, 0);
    EXPECT_THAT(text, HasSubstr("card: flat, because")) << "it moves in parallel to the picture";
    EXPECT_FALSE(std::filesystem::exists(in("out")));
    steps = 0;
    EXPECT_EQ(text_of(job, &steps), text);
    EXPECT_EQ(steps, 0) << "it was cached";
    const auto rendered = run_job(job, {}, {});
    ASSERT_TRUE(rendered) << rendered.error().text();
    ASSERT_EQ(rendered->forms.size(), 1u);
    EXPECT_EQ("card: " + form_text(rendered->forms.front()), text);
}

TEST_F(FormJob, NeedsNeitherTextureNorOutput) {
    JobSpec job = with(spec("out"), [](Region& region) {
        region.texture = {};
        region.form.shape = {{FormGuideKind::kPlane, {50, 40, 90, 40, 105, 75, 35, 75}}};
    });
    job.project.output = {};
    EXPECT_THAT(text_of(job), HasSubstr("card: plane, as drawn, tilted "));
    EXPECT_EQ(text_of(with(job,
                           [](Region& r) {
                               r.form = {};
                               r.form.source = FormSource::kFlat;
                           })),
              "card: flat, as chosen");
    EXPECT_EQ(text_of(with(job,
                           [](Region& r) {
                               r.temporal.mode = TemporalMode::kPaper;
                               r.form = {};
                           })),
              "card: flat, because a form needs the locked temporal mode");
}

TEST_F(FormJob, AShotWithoutRegionsIsAnError) {
    JobSpec job = spec("out");
    job.project.regions.clear();
    const auto result = run_form_job(job, {}, {});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kUsage);
}

}  // namespace
}  // namespace weft::test

// Every header of app/ must be included by a test.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/architecture/product_sources.h"

namespace weft::architecture {
namespace {

struct Untested {
    std::string_view path, why;
};
// Headers that tests include only through another header.
const std::vector<Untested> kThroughOthers{
    {"app/exchange/merge_settings.h", "internal: tests/exchange, through merge_project.h"},
    {"app/measure/form_measure.h", "tests/cli: weft measure"},
    {"app/measure/light_measure.h", "tests/cli: weft measure"},
    {"app/measure/measure_job.h", "tests/cli: weft measure"},
    {"app/measure/measure_report.h", "tests/cli: weft measure"},
    {"app/measure/truth_measure.h", "tests/cli: weft measure"},
    {"app/exchange/motion_schema.h", "tests/exchange, through schemas.h"},
    {"app/flatten/flat_file.h", "tests/cli: weft flatten"},
    {"app/flatten/flat_plan.h", "tests/cli: weft flatten"},
    {"app/flatten/flatten_job.h", "tests/cli: weft flatten"},
    {"app/motion_export/motion_frames.h", "tests/cli: weft motion"},
    {"app/motion_export/motion_job.h", "tests/cli: weft motion"},
    {"app/motion_export/motion_manifest.h", "tests/cli: weft motion"},
    {"app/motion_export/motion_mesh.h", "tests/cli: weft motion"},
    {"app/motion_export/motion_paths.h", "tests/cli: weft motion"},
    {"app/motion_export/motion_plan.h", "tests/cli: weft motion"},
    {"app/motion_export/motion_shapes.h", "tests/cli: weft motion"},
    {"app/preview/preview_impl.h", "internal to the preview"},
    {"app/preview/preview_overlay.h", "internal to the preview"},
    {"app/preview/preview_scenes.h", "internal to the preview"},
    {"app/preview/preview_stages.h", "internal to the preview"},
    {"app/project/choices.h", "tests/project, through parameters.h"},
    {"app/project/codec/json_codec.h", "internal: tests/project, through project_json.h"},
    {"app/project/codec/json_limits.h", "internal: tests/project, through project_json.h"},
    {"app/project/leaf.h", "tests/project, through project.h"},
    {"app/preview/normals_overlay.h", "internal: tests/preview, through preview.h"},
    {"app/project/form_parameters.h", "internal: tests/project, through parameters.h"},
    {"app/project/matte_edge_params.h", "tests/project, through matte_source.h"},
    {"app/project/matte_source.h", "tests/project, through project.h"},
    {"app/project/matte_parameters.h", "internal: tests/project, through parameters.h"},
    {"app/project/look_parameters.h", "internal: tests/project, through parameters.h"},
    {"app/project/parameter_entry.h", "internal: tests/project, through parameters.h"},
    {"app/project/parameter_lists.h", "internal: tests/project, through parameters.h"},
    {"app/composites/composite.h", "tests/cli: the exported composites"},
    {"app/render/composite_files.h", "tests/cli: the exported composites"},
    {"app/render/output_plan.h", "tests/cli: every command that writes"},
    {"app/render/plane_file.h", "tests/cli: the exported plane"},
    {"app/render/st_map_files.h", "tests/cli: the exported ST-maps"},
    {"app/shot/settled_region.h", "internal: tests/shot and tests/render, through shot.h"},
    {"app/session/action.h", "tests/ui, through session.h"},
    {"app/session/matte_actions.h", "tests/ui, through session.h"},
    {"app/base/detached_process.h", "tests/session, through app/jobs/job_worker.cpp"},
    {"app/jobs/job_process.h", "tests/session, through child_jobs.h"},
    {"app/jobs/job_progress.h", "internal: tests/session, through child_jobs.h"},
    {"app/jobs/job_view.h", "tests/session, through child_jobs.h"},
    {"app/jobs/job_worker.h", "internal: tests/session, through child_jobs.h"},
    {"app/session/document/document_files.h", "internal: tests/session, through Session"},
    {"app/session/document/document_opening.h", "internal: tests/session, through Session"},
    {"app/session/document/document_saving.h", "internal: tests/session, through Session"},
    {"app/session/document/document_trust.h", "internal: tests/session, through Session"},
    {"app/session/document/recent_projects.h", "internal: tests/session, through Session"},
    {"app/session/document/shutdowns.h", "internal: tests/session, through Session"},
    {"app/session/jobs/measured_result.h", "internal: tests/session, through Session"},
    {"app/session/jobs/flat_painting.h", "internal: tests/session, through Session"},
    {"app/session/jobs/measurement.h", "internal: tests/session, through Session"},
    {"app/session/jobs/renders.h", "internal: tests/session, through Session"},
    {"app/session/mattes/cryptomatte_pick.h", "internal: tests/session, through Session"},
    {"app/session/mattes/kept_mattes.h", "internal: tests/session, through Session"},
    {"app/session/mattes/matte_changes.h", "internal: tests/session, through Session"},
    {"app/session/mattes/matte_export.h", "internal: tests/session, through Session"},
    {"app/session/mattes/matte_folder.h", "internal: tests/session, through Session"},
    {"app/session/mattes/matte_shapes.h", "internal: tests/session, through Session"},
    {"app/session/mattes/matte_strokes.h", "internal: tests/session, through Session"},
    {"app/session/mattes/paint_target.h", "internal: tests/session, through Session"},
    {"app/session/mattes/scribble_trial.h", "internal: tests/session, through Session"},
    {"app/session/mattes/shown_mattes.h", "internal: tests/session, through Session"},
    {"app/session/textures/texture_choices.h", "internal: tests/session, through Session"},
    {"app/session/textures/texture_files.h", "internal: tests/session, through Session"},
    {"app/session/textures/texture_pitch.h", "internal: tests/session, through Session"},
    {"app/session/viewer/preview_desk.h", "internal: tests/session, through Session"},
    {"app/session/viewer/screens.h", "internal: tests/session, through Session"},
    {"app/session/viewer/shown_plate.h", "internal: tests/session, through Session"},
    {"app/session/viewer/shown_strip.h", "internal: tests/session, through Session"},
    {"app/session/session_parts.h", "internal: tests/session, through Session"},
    {"app/session/timeline_marks.h", "internal: tests/session, through Session"},
};

TEST(Headers, OfTheAppsRoomsAreIncludedByATest) {
    std::set<std::string, std::less<>> headers, included;
    for (const SourceFile& file : sources_below({"app"})) {
        const bool tools =
            file.path.starts_with("app/cli/") || file.path.starts_with("app/editor/");
        if (file.path.ends_with(".h") && !tools) headers.insert(file.path);
    }
    ASSERT_GT(headers.size(), 50u);
    for (const SourceFile& file : sources_below({"tests"}))
        for (const std::string& header : headers)
            if (file.contents.find("#include \"" + header + "\"") != std::string::npos)
                included.insert(header);
    for (const std::string& header : headers) {
        const bool excepted =
            std::any_of(kThroughOthers.begin(), kThroughOthers.end(),
                        [&](const Untested& other) { return other.path == header; });
        EXPECT_NE(included.contains(header), excepted)
            << header
            << (excepted ? " is included by a test: take it off the list in headers_test.cpp"
                         : " is included by no test");
    }
    for (const Untested& other : kThroughOthers)
        EXPECT_TRUE(headers.contains(other.path)) << other.path << " is not there";
}

}  // namespace
}  // namespace weft::architecture

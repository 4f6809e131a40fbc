#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/session/recipe.h"
#include "app/session/render_estimate.h"
#include "app/session/report.h"
#include "app/session/version_up.h"
#include "engine/core/frame_range.h"
#include "engine/core/parallel.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

JobSpec spec_of(const Project& project, const RunOptions& run) {
    JobSpec spec;
    spec.project = project;
    spec.backend = run.backend;
    spec.threads = run.threads;
    spec.existing = run.overwrite       ? ExistingFrames::kOverwrite
                    : run.skip_existing ? ExistingFrames::kSkip
                    : run.resume        ? ExistingFrames::kResume
                                        : ExistingFrames::kRefuse;
    spec.cache = run.cache;
    spec.texture_library = run.texture_library;
    spec.memory_bytes = run.memory_bytes;
    spec.stage = run.stage;
    return spec;
}

int dry_run(const Project& project, const RunOptions& run) {
    OpenShotOptions open;
    open.texture_library = run.texture_library;
    const auto shot = open_shot(project, open);
    if (!shot) return report_error(shot.error());
    if (const Status allowed = check_texture_licences(**shot); !allowed)
        return report_error(allowed.error());
    const ShotPlan& plan = (*shot)->plan;
    for (const std::string& warning : (*shot)->warnings)
        print_warning(warning);
    std::string text =
        "plate    " + project.plate.path + " (" + std::to_string((*shot)->plate->size().width) +
        "x" + std::to_string((*shot)->plate->size().height) + ", " + (*shot)->spaces.plate.name +
        ")\n" + "working  " + (*shot)->spaces.working.name + "\n" + "output   " +
        project.output.path + " (" + (*shot)->spaces.out.name + ")\n" + "frames   " +
        format_frame_list(plan.frames) + " (" + std::to_string(plan.frames.size()) + ")\n";
    for (std::size_t k = 0; k < plan.regions.size(); ++k) {
        const Region& region = *project.regions[(*shot)->region_index[k]];
        text += "region   " + region.name + ": " + (*shot)->textures[k].path +
                ", reference frame " + std::to_string(plan.regions[k].reference_frames.front()) +
                "\n";
    }
    OutlookInputs in;
    in.size = (*shot)->plate->size();
    in.frames = plan.frames.size();
    in.analysed = analysed_frames(project, plan.frames.front(), plan.frames.back());
    count_regions(project, in);
    in.quality = project.settings.quality;
    const std::string extension = std::filesystem::path(project.output.path).extension().string();
    in.extension = extension.empty() ? std::string_view() : std::string_view(extension).substr(1);
    in.threads = static_cast<unsigned>(run.threads > 0 ? run.threads : thread_count());
    const RenderOutlook outlook = render_outlook(in);
    char line[160];
    std::snprintf(
        line, sizeof line,
        "takes    about %.0f s on %u threads of the CPU, %.1f GB of memory, %.1f MB of disk\n",
        outlook.seconds, in.threads, static_cast<double>(outlook.memory_bytes) / 1e9,
        static_cast<double>(outlook.disk_bytes) / 1e6);
    print(stdout, text + line);
    return 0;
}

}  // namespace

int render_command(const Project& given, const RunOptions& run) {
    const Project mapped = with_mapped_roots(given, run.maps);
    const auto versioned = run.version_up ? version_up(mapped) : Expected<Project>(mapped);
    if (!versioned) return report_error(versioned.error());
    const Project& project = *versioned;
    if (run.overwrite + run.skip_existing + run.resume > 1) {
        return report_error({ErrorCode::kUsage,
                             std::string(run.resume ? "--resume" : "--skip-existing") + " and " +
                                 (run.overwrite ? "--overwrite" : "--skip-existing") +
                                 " contradict each other.",
                             {}});
    }
    if (run.dry_run) return dry_run(project, run);
    for (const std::string& path : {run.report, run.recipe}) {
        if (path.empty()) continue;
        remove_stale_temporaries(path);
        // Known before the work; the empty file is gone again at the end of this block.
        if (const auto probe = TemporaryFile::create(path); !probe)
            return report_error(probe.error());
    }
    const JobSpec spec = spec_of(project, run);
    const auto result =
        run_job(spec, cancel_on_signals(), progress_printer(run.progress, run.json));
    if (!result) return report_error(result.error());
    for (const std::string& line : result->passed_over)
        print(stderr, "weft: passed over " + line + "\n");
    for (const std::string& warning : result->warnings)
        print_warning(warning);
    const std::string report = report_json(spec, *result);
    if (!run.report.empty()) {
        if (const Status written = write_file_atomically(run.report, report); !written) {
            return report_error(written.error());
        }
    }
    if (!run.recipe.empty() && run.stage == JobStage::kAll) {
        const auto recipe = recipe_json(*result->shot, *result);
        if (!recipe) return report_error(recipe.error());
        if (const Status written = write_file_atomically(run.recipe, *recipe); !written)
            return report_error(written.error());
    }
    if (run.json) print(stdout, report);
    return 0;
}

int verify_command(const VerifyCommandOptions& given, const RunOptions& run) {
    VerifyOptions options{given.recipe, given.frames, !given.quick, spec_of({}, run)};
    const auto result =
        verify_recipe(options, cancel_on_signals(), progress_printer(run.progress, run.json));
    if (!result) return report_error(result.error());
    for (const std::string& warning : result->warnings)
        print_warning(warning);
    for (const std::string& difference : result->differences)
        print(stderr, "weft: " + difference + ".\n");
    const bool same = result->differences.empty();
    if (run.json) {
        const nlohmann::ordered_json json{{"proved", same},
                                          {"frames", result->frames},
                                          {"inputs", result->inputs},
                                          {"rerendered", !given.quick},
                                          {"differences", result->differences}};
        print(stdout, json.dump(2) + "\n");
    } else {
        print(stdout, std::string(same ? "Proved: " : "Not proved: ") +
                          std::to_string(result->frames) + " frames from " +
                          std::to_string(result->inputs) + " input files" +
                          (given.quick ? ", not rendered again.\n" : ", rendered again.\n"));
    }
    return same ? 0 : exit_code(ErrorCode::kDiffers);
}

int matte_command(const Project& project, const std::string& output, const RunOptions& run) {
    std::vector<std::string> warnings;
    const auto mattes = run_matte_job(spec_of(project, run), output, cancel_on_signals(),
                                      progress_printer(run.progress, run.json), warnings);
    for (const std::string& warning : warnings)
        print_warning(warning);
    if (!mattes) return report_error(mattes.error());
    std::string text = run.json ? "{\"mattes\": [" : "", suggested;
    for (const MatteResult& m : *mattes) {
        char line[64];
        std::snprintf(
            line, sizeof line,
            run.json ? "{\"frame\": %d, \"confidence\": %.4f}" : "matte %d confidence %.2f",
            m.frame, static_cast<double>(m.confidence));
        if (run.json && &m != &mattes->front()) text += ", ";
        text += line;
        if (m.suggested) suggested += (suggested.empty() ? "" : ", ") + std::to_string(m.frame);
        if (!run.json) text += m.suggested ? "  put a keyframe here\n" : "\n";
    }
    print(stdout, run.json ? text + "], \"suggested_keyframes\": [" + suggested + "]}\n" : text);
    return 0;
}

}  // namespace weft

#include "bench/study/study.h"

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>

#include "app/exchange/kept_textures.h"
#include "app/shot/frame_plan.h"
#include "bench/study/study_methods.h"
#include "bench/study/study_pictures.h"
#include "bench/study/study_report.h"
#include "engine/core/frame_range.h"
#include "engine/media/atomic_file.h"
#include "engine/media/frame_writer.h"
#include "engine/pipeline/sweep.h"

namespace weft {
namespace {

double cpu_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

namespace fs = std::filesystem;

class Study {
  public:
    Study(const StudyOptions& options, const CancelToken& cancel, const ProgressFn& progress)
        : options_(options), cancel_(cancel), progress_(progress) {
        result_.project = options.project;
    }

    Expected<StudyResult> run() {
        use_threads(options_.threads);
        WEFT_CHECK_OK(prepare());
        Project to_render = result_.project;
        if (!options_.render_with_motion) {
            to_render.regions.front() =
                to_render.regions.front().with([](Region& r) { r.motion.files.clear(); });
        }
        WEFT_TRY(methods, plan_study(options_, to_render, plane_path_));
        for (StudyMethod& method : methods) {
            if (auto rendered = render(method); !rendered)
                return fail_in(std::move(rendered).error(), method.run.title);
            result_.runs.push_back(std::move(method.run));
        }
        WEFT_CHECK_OK(measure());
        result_.verdict = study_verdict(result_.runs);
        WEFT_CHECK_OK(add_study_pictures(result_, cancel_));
        WEFT_CHECK_OK(write());
        return std::move(result_);
    }

  private:
    [[nodiscard]] std::string in(const char* name) const { return options_.folder + "/" + name; }

    // A study leaves many files; among the frames they would be taken for frames.
    [[nodiscard]] Status check_apart_from_inputs() const {
        const std::string folder = real_path((fs::path(options_.folder) / "x").string());
        std::string within;
        static_cast<void>(map_paths(result_.project, [&](const std::string& path) {
            if (fs::path(real_path(path)).parent_path() == fs::path(folder).parent_path())
                within = path;
            return path;
        }));
        if (within.empty()) return {};
        return fail(ErrorCode::kUsage,
                    "The output folder " + options_.folder + " holds an input of the study, " +
                        within + ".",
                    "Choose another folder.");
    }

    Status prepare() {
        if (options_.folder.empty())
            return fail(ErrorCode::kUsage, "No output folder is set.", "Give one with -o.");
        WEFT_CHECK_OK(check_study(options_));
        WEFT_TRY(fence, make_fence(result_.project, options_.limits));
        rule_.fence = fence;
        rule_.existing = existing_by(options_.overwrite);
        WEFT_CHECK_OK(check_apart_from_inputs());
        WEFT_CHECK_OK(make_folder(options_.folder, rule_));
        for (const char* name : {"report.json", "report.csv", "report.html"})
            WEFT_CHECK_OK(check_output(in(name), rule_));
        const std::string textures = in("textures");
        WEFT_TRY(kept, keep_library_textures(result_.project, textures, textures,
                                             options_.texture_library, rule_));
        result_.project = std::move(kept);
        if (result_.project.regions.size() != 1)
            return fail(ErrorCode::kUsage, "A study needs exactly one region.");
        WEFT_TRY(shot, open_shot(result_.project));
        WEFT_CHECK_OK(check_texture_licences(*shot));
        result_.frames = shot->plan.frames;
        result_.size = shot->plate->size();
        result_.warnings = shot->warnings;
        if (result_.frames.size() < 2 || result_.frames.back() - result_.frames.front() + 1 !=
                                             static_cast<int>(result_.frames.size())) {
            return fail(ErrorCode::kUsage,
                        "A study needs at least two consecutive frames (--frames 1-24).");
        }
        result_.project.settings.frames = format_frame_list(result_.frames);
        if (result_.project.regions.front()->matte->files.empty()) WEFT_CHECK_OK(make_mattes());
        set_reference();
        return make_plane();
    }

    // Measuring needs a matte for every frame.
    Status make_mattes() {
        JobSpec spec = job(result_.project);
        const std::string pattern = in("mattes/#####.png");
        WEFT_TRY(mattes, run_matte_job(spec, pattern, cancel_, staged("mattes"), result_.warnings));
        result_.project.regions.front() = result_.project.regions.front().with([&](Region& r) {
            MatteSource files;
            files.files = pattern;
            r.matte = files;
        });
        return {};
    }

    // The ideal texture is placed by the first frame.
    void set_reference() {
        if (!result_.project.regions.front()->reference_frames.empty()) return;
        result_.project.regions.front() = result_.project.regions.front().with(
            [&](Region& r) { r.reference_frames = {result_.frames.front()}; });
    }

    Status make_plane() {
        const Region& region = *result_.project.regions.front();
        WEFT_TRY(shot, open_shot(result_.project));
        WEFT_TRY(plane, ideal_plane(result_.project, shot->plan.regions.front(), result_.size));
        ImageF3 picture(plane.size());
        std::transform(plane.data(), plane.data() + plane.size_bytes(), picture.data(),
                       [](std::uint8_t v) { return static_cast<float>(v) / 255.0f; });
        plane_path_ = in("plane.png");
        result_.estimated_ideal = region.motion.files.empty();
        WriteOptions write;
        write.rule = rule_;
        return write_image(plane_path_, picture, {}, write);
    }

    [[nodiscard]] JobSpec job(const Project& project) const {
        JobSpec spec;
        spec.project = project;
        spec.threads = options_.threads;
        spec.existing = options_.overwrite ? ExistingFrames::kOverwrite : ExistingFrames::kRefuse;
        spec.limits = options_.limits;
        // Every method computes its own analysis; otherwise the times would depend on the order.
        spec.cache.keep = false;
        return spec;
    }

    [[nodiscard]] ProgressFn staged(const std::string& name) const {
        if (!progress_) return {};
        return [this, name](const ProgressEvent& event) {
            ProgressEvent named = event;
            named.title = name + " " + event.name();
            progress_(named);
        };
    }

    Status render(StudyMethod& method) {
        if (cancel_.cancelled()) return cancelled(cancel_);
        const ProgressFn progress = staged(method.run.id);
        const double before = cpu_seconds();
        if (method.kind == StudyMethod::Kind::kJob) {
            WEFT_TRY(rendered, run_job(job(method.project), cancel_, progress));
            method.run.seconds = rendered.seconds;
            if (!rendered.planes.empty()) method.run.plane = rendered.planes.front();
            result_.backend = rendered.backend;
        } else {
            WEFT_TRY(seconds, render_baseline(method, plane_path_, rule_, cancel_, progress));
            method.run.seconds = seconds;
        }
        method.run.cpu_s = cpu_seconds() - before;
        return {};
    }

    Status measure() {
        MeasureJobOptions job;
        job.project = result_.project;
        job.project.color.out_space.clear();
        job.project.regions.front() = job.project.regions.front().with([&](Region& r) {
            r.texture.sample.clear();
            r.texture.also.clear();
            // A texture synthesized from a sample is not fitted into corners.
            if (result_.project.regions.front()->texture.plane.empty()) r.placement.fit = false;
            r.texture.plane = plane_path_;
            r.texture.space.clear();
        });
        job.project.color.texture_space = "srgb";
        job.ideal_by_estimate = true;
        job.cache.keep = false;
        for (const StudyRun& run : result_.runs)
            job.results.push_back(run.pattern);
        std::int64_t done = 0;
        const auto total = static_cast<std::int64_t>(job.results.size() * result_.frames.size());
        job.measured = [&](std::size_t, const FrameMeasures& f) {
            if (progress_) progress_({WorkStage::kMeasure, ++done, total, f.frame, 0});
        };
        WEFT_TRY(measured, run_measure_job(job, cancel_));
        for (const std::string& warning : measured.warnings) {
            if (std::find(result_.warnings.begin(), result_.warnings.end(), warning) ==
                result_.warnings.end())
                result_.warnings.push_back(warning);
        }
        result_.light = measured.light;
        for (std::size_t k = 0; k < result_.runs.size(); ++k)
            result_.runs[k].measured = std::move(measured.results[k]);
        return {};
    }

    [[nodiscard]] Status write() const {
        WEFT_CHECK_OK(write_file_atomically(in("report.json"), study_json(result_), rule_));
        WEFT_CHECK_OK(write_file_atomically(in("report.csv"), study_csv(result_), rule_));
        return write_file_atomically(in("report.html"), study_html(result_), rule_);
    }

    const StudyOptions& options_;
    CancelToken cancel_;
    const ProgressFn& progress_;
    StudyResult result_;
    WriteRule rule_;  // of what lies in the folder itself
    std::string plane_path_;
};

}  // namespace

const StudyRun* StudyResult::find(const std::string& id) const {
    const auto at =
        std::find_if(runs.begin(), runs.end(), [&](const StudyRun& r) { return r.id == id; });
    return at == runs.end() ? nullptr : &*at;
}

std::optional<double> above_floor(const SequenceMeasures& measures) {
    if (measures.tde_floor.frames == 0 || measures.tde_at_floor.frames == 0) return std::nullopt;
    return measures.tde_at_floor.mean - measures.tde_floor.mean;
}

StudyVerdict study_verdict(const std::vector<StudyRun>& runs) {
    constexpr double kSharpEnough = 0.90;
    StudyVerdict out;
    double paper_alpha = 0;
    for (const StudyRun& run : runs) {
        const SequenceMeasures& m = run.measured.all;
        const auto above = above_floor(m);
        if (!above) continue;
        out.floor = m.tde_floor.mean;
        if (run.role == StudyRole::kLocked) out.locked = above;
        if (run.role == StudyRole::kBaseline && (!out.baseline || *above < *out.baseline)) {
            out.baseline = above;
            out.baseline_id = run.id;
        }
        const bool sharp = m.sharpness_kept.frames > 0 && m.sharpness_kept.mean >= kSharpEnough;
        if (run.role == StudyRole::kPaper && sharp && (!out.paper || run.alpha < paper_alpha)) {
            out.paper = above;
            out.paper_id = run.id;
            paper_alpha = run.alpha;
        }
    }
    const auto reduction = [&](const std::optional<double>& other) -> std::optional<double> {
        if (!out.locked || !other || *other <= 0) return std::nullopt;
        return 100.0 * (1.0 - *out.locked / *other);
    };
    out.reduction_percent = reduction(out.baseline);
    out.paper_reduction_percent = reduction(out.paper);
    return out;
}

Expected<StudyResult> run_study(const StudyOptions& options, const CancelToken& cancel,
                                const ProgressFn& progress) {
    return Study(options, cancel, progress).run();
}

}  // namespace weft

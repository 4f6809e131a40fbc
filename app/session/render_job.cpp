#include "app/session/render_job.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>
#include <opencv2/core/utility.hpp>

#include "app/session/burn_in.h"
#include "app/session/existing_frames.h"
#include "app/session/frame_plan.h"
#include "app/session/job_warnings.h"
#include "app/session/layer_files.h"
#include "app/session/memory_plan.h"
#include "app/session/output_check.h"
#include "app/session/planes_ahead.h"
#include "app/session/recipe.h"
#include "app/session/stage_cache.h"
#include "app/session/version_up.h"
#include "engine/core/parallel.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"
#include "engine/media/sequence_pattern.h"
#include "engine/pipeline/analyse.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/render_frame.h"
#include "engine/pipeline/synthesis_inputs.h"
#include "gpu/cuda_backend.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

class RenderJob {
  public:
    RenderJob(const JobSpec& spec, CancelToken cancel, const ProgressFn& progress)
        : spec_(spec), cancel_(std::move(cancel)), progress_(progress) {}

    Expected<JobResult> run() {
        const auto start = Clock::now();
        WEFT_CHECK_OK(open());
        result_.seconds.open = seconds_since(start);
        const auto work = Clock::now();
        if (spec_.stage == JobStage::kMotion) {
            WEFT_CHECK_OK(keep_motion(*shot_->source, plan_, shot_->plan.frames, whole_span(),
                                      cancel_, progress_));
            return std::move(result_);
        }
        grow_planes_ahead();
        WEFT_CHECK_OK(timed(result_.seconds.analyse, [&]() -> Status {
            if (to_render_.empty() || spec_.stage == JobStage::kEncode) return {};
            return analyse_shot(*shot_->source, plan_, *store_, cancel_, progress_, backend_.get());
        }));
        WEFT_CHECK_OK(timed(result_.seconds.synthesise, [&] { return make_scenes(); }));
        if (spec_.stage == JobStage::kAnalyse || spec_.stage == JobStage::kPlanes)
            return std::move(result_);
        WEFT_CHECK_OK(timed(result_.seconds.render, [&] { return render_all(); }));
        result_.fps = static_cast<double>(to_render_.size()) / std::max(1e-9, seconds_since(work));
        result_.seconds.total = seconds_since(start);
        finish_warnings();
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        result_.peak_rss_bytes = static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
        return std::move(result_);
    }

  private:
    template <class F>
    static Status timed(double& seconds, F&& work) {
        const auto start = Clock::now();
        Status status = work();
        seconds = seconds_since(start);
        return status;
    }

    Status open() {
        use_threads(spec_.threads);
        WEFT_TRY(choice, choose_backend(spec_.backend));
        backend_ = choice.backend;
        result_.backend = backend_->name();
        result_.backend_description = backend_->description();
        result_.passed_over = choice.passed_over;

        if (spec_.project.output.path.empty()) {
            return fail(ErrorCode::kUsage,
                        "No output is set. Give a pattern with -o, such as 'out/####.png'.");
        }
        WEFT_TRY(pattern, SequencePattern::parse(spec_.project.output.path));
        pattern_ = pattern;
        OpenShotOptions open;
        open.texture_library = spec_.texture_library;
        if (spec_.memory_bytes > 0) {
            open.cache_bytes = std::min(open.cache_bytes,
                                        static_cast<std::size_t>(spec_.memory_bytes) / kCacheShare);
        }
        WEFT_TRY(shot, open_shot(spec_.project, open));
        WEFT_CHECK_OK(check_texture_licences(*shot));
        shot_ = result_.shot = shot;
        WEFT_TRY(at_once, frames_at_once(shot->plate->size(), spec_.memory_bytes));
        frames_at_once_ = at_once;
        plan_ = shot_->plan;
        result_.warnings = shot_->warnings;
        result_.spaces = shot_->spaces;
        result_.textures = shot_->textures;
        result_.size = shot_->plate->size();
        if (plan_.regions.empty()) {
            return fail(ErrorCode::kUsage,
                        "There is no region to replace. Add one with a matte and a texture.");
        }
        if (pattern_->is_single() && plan_.frames.size() > 1) {
            return fail(ErrorCode::kUsage, "The output " + pattern_->text() +
                                               " has no frame number for " +
                                               std::to_string(plan_.frames.size()) +
                                               " frames. Write it like 'out/####.png'.");
        }
        WEFT_CHECK_OK(choose_format());
        WEFT_CHECK_OK(check_existing());
        WEFT_TRY(store, open_analysis_cache(*shot_, spec_.cache, result_.warnings));
        store_ = store;
        if (const std::string root = cache_root(spec_.cache); spec_.cache.keep && !root.empty()) {
            WEFT_TRY(stages, open_stage_cache(*shot_, root));
            plan_.stages = stages;
        }
        return {};
    }

    Status choose_format() {
        const Output& output = shot_->project.output;
        write_.depth = output_depth(output, shot_->plate->depth());
        write_.jpeg_quality = output.jpeg_quality;
        write_.exr_compression = output.exr_compression;
        write_.metadata = recipe_metadata(*shot_, result_.backend);
        write_.pixel_aspect = shot_->plate->pixel_aspect();
        WEFT_TRY(layers, parse_layer_names(output.layers));
        layer_names_ = std::move(layers);
        WEFT_CHECK_OK(choose_layer_files());
        return check_format(output.path, write_);
    }

    // Layers go into the output where it is an EXR, else into files of their own.
    Status choose_layer_files() {
        const Output& output = shot_->project.output;
        is_exr_ = output.path.ends_with(".exr") || output.path.ends_with(".EXR");
        if (layer_names_.empty()) return {};
        if (output.layers_path.empty()) {
            if (is_exr_) return {};
            return fail(ErrorCode::kUsage,
                        "Layers need an EXR. Write the output as .exr, or give the layers files of "
                        "their own with --layers-output 'layers/####.exr'.");
        }
        WEFT_TRY(pattern, SequencePattern::parse(output.layers_path));
        WEFT_CHECK_OK(check_format(output.layers_path, {.depth = PixelDepth::kHalf}));
        WEFT_CHECK_OK(make_output_folder(pattern.path_for(plan_.frames.front())));
        remove_stale_temporaries(pattern.path_for(plan_.frames.front()));
        layer_pattern_ = std::move(pattern);
        return {};
    }

    Status write_frame(int frame, const std::string& path, const RenderedFrame& rendered,
                       const ImageF1& alpha) const {
        std::vector<ExrLayer> layers;
        if (rendered.layers) layers = exr_layers(*rendered.layers, layer_names_);
        if (layer_pattern_) {
            const ExrFrame apart{rendered.pixels, {}, {}, {}, {}, std::move(layers)};
            WriteOptions half = write_;
            half.depth = PixelDepth::kHalf;
            WEFT_CHECK_OK(write_exr(layer_pattern_->path_for(frame), apart, half));
            layers.clear();
        }
        if (!is_exr_) return write_image(path, rendered.pixels, alpha, write_);
        ExrFrame exr{rendered.pixels, alpha, {}, {}, {}, std::move(layers)};
        const std::string source = shot_->plate->path_of(frame);
        const std::string& layer = shot_->project.plate.layer;
        // Of the plate's own depth: else it would be another kind of picture.
        if (write_.depth == shot_->plate->depth() && is_exr_with_colour(source, layer)) {
            exr.source = source;
            exr.source_layer = layer;
            if (shot_->spaces.plate == shot_->spaces.out) exr.touched = rendered.touched;
        }
        return write_exr(path, exr, write_);
    }

    // What stands for a frame that the plate has not, where it is to be black.
    [[nodiscard]] bool is_black(int frame) const {
        return shot_->project.plate.missing == MissingFrames::kBlack &&
               shot_->plate->shown_frame(frame) != frame;
    }

    // Makes the folder, and decides about frames that are there already, before any work is done.
    Status check_existing() {
        WEFT_CHECK_OK(make_output_folder(pattern_->path_for(plan_.frames.front())));
        remove_stale_temporaries(pattern_->path_for(plan_.frames.front()));
        WEFT_TRY(probe, TemporaryFile::create(pattern_->path_for(plan_.frames.front())));
        for (const int frame : plan_.frames)
            WEFT_CHECK_OK(check_no_input(*shot_, frame, pattern_->path_for(frame)));
        WEFT_CHECK_OK(check_movie());
        const bool writes = spec_.stage == JobStage::kAll || spec_.stage == JobStage::kFrames;
        const ExistingFrames existing = writes ? spec_.existing
                                        : spec_.stage == JobStage::kEncode
                                            ? ExistingFrames::kResume
                                            : ExistingFrames::kOverwrite;
        WEFT_TRY(kept, frames_to_keep(*pattern_, plan_.frames, shot_->plate->size(), existing,
                                      write_.metadata));
        for (const int frame : plan_.frames) {
            const bool skip = std::binary_search(kept.begin(), kept.end(), frame);
            result_.frames.push_back({frame, pattern_->path_for(frame), 0, skip, 0, 0});
            if (!skip) to_render_.push_back(frame);
        }
        // Only what is still to be rendered has to be analysed.
        plan_.frames = to_render_;
        return {};
    }

    Status check_movie() const {
        const std::string& path = shot_->project.output.movie;
        std::error_code error;
        if (path.empty() || spec_.stage == JobStage::kFrames) return {};
        remove_stale_temporaries(path);
        if (!fs::exists(path, error)) return {};
        WEFT_CHECK_OK(check_no_input(*shot_, plan_.frames.front(), path));
        if (spec_.existing != ExistingFrames::kRefuse) return {};
        return fail(ErrorCode::kUsage, path + " exists already. Use --overwrite, or another name.");
    }

    // All frames that some region's analysis goes through.
    [[nodiscard]] FrameSpan whole_span() const {
        FrameSpan out = analysed_span(plan_, plan_.regions.front());
        for (const RegionPlan& region : plan_.regions) {
            const FrameSpan span = analysed_span(plan_, region);
            out = {std::min(out.first, span.first), std::max(out.last, span.last)};
        }
        return out;
    }

    // Beside the analysis, whose steps leave other processors idle. Not where memory is short: then
    // planes and analysis are not held at the same time.
    void grow_planes_ahead() {
        const bool wanted = spec_.stage == JobStage::kAll && !to_render_.empty();
        if (!wanted || thread_count() == 1 || spec_.memory_bytes > 0) return;
        planes_ahead_.emplace(plan_, shot_->source->size(), cancel_, backend_.get());
    }

    Status make_scenes() {
        if (to_render_.empty() || spec_.stage == JobStage::kAnalyse) return {};
        if (spec_.stage == JobStage::kEncode) {
            return fail(ErrorCode::kMissingFrames,
                        "The movie needs all frames, and " + frames_text(to_render_) +
                            " of them are missing or of other settings. Render them first.");
        }
        for (std::size_t k = 0; k < plan_.regions.size(); ++k) {
            if (const auto& texture = *plan_.regions[k].texture; !texture.is_plane) {
                const auto samples = synthesis_samples(plan_.regions[k]);
                for (std::size_t i = 0; i < samples.size(); ++i) {
                    const auto warning = sample_warning(samples[i]);
                    const ShotTexture& first = shot_->textures[k];
                    const std::string& path = i == 0 ? first.path : first.also[i - 1].path;
                    if (warning) result_.warnings.push_back(path + ": " + *warning);
                }
            }
            WEFT_CHECK_OK(check_reference(k));
            auto scene = scene_of(k);
            if (!scene) {
                const std::size_t at = shot_->region_index[k];
                return fail_in(std::move(scene).error(), "Region '" +
                                                             shot_->project.regions[at]->name +
                                                             "' with " + shot_->textures[k].path);
            }
            result_.planes.push_back(scene->stats);
            scenes_.push_back(std::move(*scene));
        }
        return {};
    }

    Expected<RegionScene> scene_of(std::size_t region) {
        std::optional<RegionPlane> plane;
        if (planes_ahead_) {
            WEFT_TRY(made, planes_ahead_->take(region));
            plane = std::move(made);
        }
        return make_scene(*shot_->source, plan_, *store_, static_cast<int>(region), cancel_, {},
                          backend_.get(), std::move(plane));
    }

    // Where the reference frame shows nothing of the surface, there is no light to compare with and
    // nothing to follow from there.
    Status check_reference(std::size_t region) {
        const int frame = plan_.regions[region].reference_frames.front();
        WEFT_TRY(extent,
                 extent_matte(*shot_->source, plan_, *store_, static_cast<int>(region), frame));
        if (matte_bounds(extent).empty()) empty_references_.emplace_back(region, frame);
        return {};
    }

    Status render_all() {
        std::unique_ptr<MovieWriter> movie;
        if (!shot_->project.output.movie.empty() && spec_.stage != JobStage::kFrames) {
            WEFT_TRY(opened, open_review_movie());
            movie = std::move(opened);
        }
        // A batch of frames at a time, so that the movie gets them in order and memory stays
        // bounded.
        const auto batch = std::min(static_cast<std::size_t>(2 * thread_count()), frames_at_once_);
        for (std::size_t first = 0; first < result_.frames.size(); first += batch) {
            const std::size_t count = std::min(batch, result_.frames.size() - first);
            std::vector<Status> status(count);
            std::vector<ImageF3> display(movie ? count : 0);
            parallel_for(count, [&](std::size_t k) {
                status[k] = one_frame(result_.frames[first + k], movie ? &display[k] : nullptr);
            });
            for (std::size_t k = 0; k < count; ++k) {
                if (!status[k]) {
                    return fail_in(std::move(status[k]).error(),
                                   "Frame " + std::to_string(result_.frames[first + k].frame));
                }
                if (movie) WEFT_CHECK_OK(movie->add(display[k]));
            }
        }
        return movie ? movie->close() : Status{};
    }

    Expected<std::unique_ptr<MovieWriter>> open_review_movie() {
        const std::string& path = shot_->project.output.movie;
        const double given = shot_->project.plate.fps, of_plate = shot_->plate->fps();
        WEFT_TRY(display_from_out, make_color_transform(shot_->spaces.out, {"srgb"}));
        display_from_out_ = display_from_out;
        result_.movie = path;
        return open_movie(path, shot_->plate->size(),
                          given > 0      ? given
                          : of_plate > 0 ? of_plate
                                         : 24.0,
                          shot_->plate->pixel_aspect());
    }

    [[nodiscard]] std::string burnt_text(int frame) const {
        const auto version = version_in(shot_->project.output.path);
        char text[96];
        std::snprintf(text, sizeof text, "%d   %s%s", frame,
                      version ? ("v" + std::to_string(*version)).c_str() : "",
                      version ? "   " : "");
        return text + shot_->spaces.out.name;
    }

    Status one_frame(FrameResult& result, ImageF3* display) {
        if (cancel_.cancelled()) return cancelled(cancel_);
        const auto start = Clock::now();
        if (!result.skipped && is_black(result.frame)) {
            WEFT_CHECK_OK(write_image(result.path, ImageF3(shot_->plate->size()), {}, write_));
        } else if (!result.skipped) {
            // A held frame is the frame that stands for it, grain and all.
            const int shown = shot_->plate->shown_frame(result.frame);
            WEFT_TRY(rendered,
                     render_frame(*shot_->source, plan_, scenes_, *store_, *backend_, shown));
            WEFT_TRY(decoded, shot_->plate->read_shared(result.frame));
            WEFT_CHECK_OK(write_frame(result.frame, result.path, rendered, decoded->alpha));
            result.above_one = rendered.above_one;
            result.filled = rendered.filled;
            result.nonfinite = decoded->nonfinite;
            result.untouched = matte_bounds(rendered.touched).empty();
        }
        if (display) {
            // As it is on the disk, so that the movie of a resumed run is the same.
            WEFT_TRY(written, read_image(result.path));
            display_from_out_->apply(written.rgb);
            if (shot_->project.output.burn_in) burn_in(written.rgb, burnt_text(result.frame));
            *display = std::move(written.rgb);
        }
        result.seconds = seconds_since(start);
        const std::lock_guard lock(progress_mutex_);
        ++done_;
        if (progress_) {
            progress_({"render", done_, static_cast<std::int64_t>(result_.frames.size()),
                       result.frame, result.seconds});
        }
        return {};
    }

    void finish_warnings() {
        if (const std::vector<int> cuts = shot_->cuts->cuts(); !cuts.empty()) {
            result_.warnings.push_back(
                "A new scene seems to begin at " + frames_text(cuts) +
                ". A surface is not followed across a cut: render each scene by itself "
                "(--frames, with a reference frame in each).");
        }
        const bool some_touched =
            std::any_of(result_.frames.begin(), result_.frames.end(),
                        [](const FrameResult& f) { return !f.untouched && !f.skipped; });
        for (const auto& [region, frame] : empty_references_) {
            if (!some_touched) break;
            result_.warnings.push_back(
                "Region '" + shot_->project.regions[shot_->region_index[region]]->name +
                "': its matte is empty on the reference frame " + std::to_string(frame) +
                ". Place the texture on a frame that shows the surface (--reference-frame).");
        }
        for (const std::vector<std::string>& lines :
             {warnings_of(result_.frames), backend_->remarks()}) {
            result_.warnings.insert(result_.warnings.end(), lines.begin(), lines.end());
        }
    }

    const JobSpec& spec_;
    CancelToken cancel_;
    const ProgressFn& progress_;
    JobResult result_;
    std::shared_ptr<const Backend> backend_;
    std::optional<SequencePattern> pattern_;
    std::shared_ptr<const Shot> shot_;
    ShotPlan plan_;  // the shot's, less the frames that are there already
    std::vector<int> to_render_;
    WriteOptions write_;
    std::shared_ptr<AnalysisStore> store_;
    std::vector<RegionScene> scenes_;
    std::optional<PlanesAhead> planes_ahead_;
    std::vector<std::pair<std::size_t, int>> empty_references_;  // region, frame
    std::shared_ptr<const ColorTransform> display_from_out_;
    std::vector<std::string> layer_names_;
    std::optional<SequencePattern> layer_pattern_;  // of files of their own
    bool is_exr_ = false;
    std::size_t frames_at_once_ = 1;
    std::mutex progress_mutex_;
    std::int64_t done_ = 0;
};

}  // namespace

Expected<JobStage> parse_job_stage(const std::string& name) {
    static const std::map<std::string, JobStage> kNames{
        {"all", JobStage::kAll},         {"motion", JobStage::kMotion},
        {"analyse", JobStage::kAnalyse}, {"planes", JobStage::kPlanes},
        {"frames", JobStage::kFrames},   {"encode", JobStage::kEncode}};
    const auto at = kNames.find(name);
    if (at != kNames.end()) return at->second;
    return fail(ErrorCode::kUsage,
                "There is no stage '" + name +
                    "'. There are motion, analyse, planes, frames, encode, all.");
}

Expected<BackendChoice> choose_backend(const std::string& name) {
    BackendRegistry registry;
    register_cuda(registry);
    return registry.choose(name);
}

void keep_libraries_steady() {
    // Debian's OpenCV blurs, derives and scales floats with FMA where the processor has AVX2, and
    // without where it has not.
    cv::setUseOptimized(false);
}

void use_threads(int threads) {
    keep_libraries_steady();
    set_thread_count(threads);
    cv::setNumThreads(thread_count());
}

Expected<JobResult> run_job(const JobSpec& spec, const CancelToken& cancel,
                            const ProgressFn& progress) {
    return RenderJob(spec, cancel, progress).run();
}

}  // namespace weft

#include "app/render/render_job.h"

#include <sys/resource.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <map>
#include <opencv2/core/utility.hpp>

#include "app/cache/analysis_claim.h"
#include "app/cache/stage_cache.h"
#include "app/render/job_frames.h"
#include "app/render/job_setup.h"
#include "app/render/job_warnings.h"
#include "app/render/plane_file.h"
#include "app/render/planes_ahead.h"
#include "app/render/unreadable_evidence.h"
#include "app/shot/frame_plan.h"
#include "engine/core/parallel.h"
#include "engine/core/setting.h"
#include "engine/core/stopwatch.h"
#include "engine/pipeline/analyse.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/synthesis_inputs.h"
#include "gpu/cuda_backend.h"

namespace weft {
namespace {

template <class F>
Status timed(double& seconds, F&& work) {
    const auto start = Clock::now();
    Status status = work();
    seconds = seconds_since(start);
    return status;
}

// A prepared job and the results of its stages.
struct JobRun {
    const JobSpec& spec;
    const CancelToken& cancel;
    const ProgressFn& progress;
    JobSetup setup;
    ShotPlan plan;  // the prepared plan, with the stage cache
    std::shared_ptr<AnalysisCache> store;
    std::vector<RegionScene> scenes;
    std::vector<std::string> empty_references;  // one warning each

    [[nodiscard]] const Shot& shot() const { return *setup.shot; }
    [[nodiscard]] bool nothing_to_render() const { return plan.frames.empty(); }
};

Status open_caches(JobRun& job) {
    AnalysisCacheOptions cache = job.spec.cache;
    cache.required = job.spec.stage == JobStage::kAnalyse;
    WEFT_TRY(store, open_analysis_cache(job.shot(), cache, job.setup.result.warnings));
    job.store = store;
    if (const std::string root = cache_root(job.spec.cache); job.spec.cache.keep && !root.empty())
        job.plan.stages = open_stage_cache(job.shot(), root);
    return {};
}

// ---- motion ----------------------------------------------------------------------------------

// All frames that the analysis of some region needs.
FrameSpan whole_span(const ShotPlan& plan) {
    FrameSpan out = analysed_span(plan, plan.regions.front());
    for (const RegionPlan& region : plan.regions) {
        const FrameSpan span = analysed_span(plan, region);
        out = {std::min(out.first, span.first), std::max(out.last, span.last)};
    }
    return out;
}

Status motion_stage(const JobRun& job) {
    return keep_motion(*job.shot().source, job.plan, job.shot().plan.frames, whole_span(job.plan),
                       job.cancel, job.progress);
}

// ---- analysis --------------------------------------------------------------------------------

Status analysis_stage(const JobRun& job) {
    if (job.nothing_to_render() || job.spec.stage == JobStage::kEncode) return {};
    const auto claim =
        claim_analysis(*job.store, job.plan, kRenderPatience, job.cancel, job.progress);
    return analyse_shot(*job.shot().source, job.plan, *job.store, job.cancel, job.progress,
                        job.setup.backend.get());
}

// ---- planes ----------------------------------------------------------------------------------

// Synthesizes planes during the analysis, whose steps leave processors idle. Not if memory is
// limited, because both would be in memory at the same time.
void grow_planes_ahead(const JobRun& job, std::optional<PlanesAhead>& planes) {
    const bool wanted = job.spec.stage == JobStage::kAll && !job.nothing_to_render();
    if (!wanted || thread_count() == 1 || job.spec.memory_bytes > 0) return;
    planes.emplace(job.plan, job.shot().source->size(), job.cancel, job.setup.backend.get());
}

void warn_of_samples(JobRun& job, std::size_t region) {
    if (job.plan.regions[region].texture->is_plane) return;
    const auto samples = synthesis_samples(job.plan.regions[region]);
    const ShotTexture& first = job.shot().textures[region];
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::string& path = i == 0 ? first.path : first.also[i - 1].path;
        if (const auto warning = sample_warning(samples[i]))
            job.setup.result.warnings.push_back(path + ": " + *warning);
    }
}

void warn_of_gloss(JobRun& job, std::size_t region, const RegionScene& scene) {
    constexpr float kUnsure = 0.5f;
    const float sure = std::max(scene.colours.confidence, scene.still.confidence);
    if (!(job.plan.regions[region].highlights > 0) || sure >= kUnsure) return;
    const Shot& shot = job.shot();
    const Region& of = *shot.project.regions[shot.region_index[region]];
    job.setup.result.warnings.push_back(unsure_highlights_text(of.name));
}

// If the surface is not visible on the reference frame, there is no light to compare with and
// nothing to track.
Status check_reference(JobRun& job, std::size_t region) {
    const Shot& shot = job.shot();
    ShotReference reference = shot.references[region];
    if (reference.shows_nothing && reference.better) return {};  // open_shot() has warned about it
    WEFT_TRY(extent, extent_matte(*shot.source, job.plan, *job.store, static_cast<int>(region),
                                  reference.frame));
    if (!matte_bounds(extent).empty()) return {};
    const Region& of = *shot.project.regions[shot.region_index[region]];
    const auto other = choose_reference(of, *shot.plate, nullptr);
    if (other && other->shown && other->frame != reference.frame) reference.better = other->frame;
    job.empty_references.push_back(empty_reference_text(of.name, reference));
    return {};
}

Expected<RegionScene> scene_of(const JobRun& job, std::size_t region,
                               std::optional<PlanesAhead>& planes) {
    std::optional<RegionPlane> plane;
    if (planes) {
        WEFT_TRY(made, planes->take(region));
        plane = std::move(made);
    }
    return make_scene(*job.shot().source, job.plan, *job.store, static_cast<int>(region),
                      job.cancel, {}, job.setup.backend.get(), std::move(plane));
}

Status plane_stage(JobRun& job, std::optional<PlanesAhead>& planes) {
    if (job.nothing_to_render() || job.spec.stage == JobStage::kAnalyse) return {};
    if (job.spec.stage == JobStage::kEncode) {
        return fail(ErrorCode::kMissingFrames,
                    "The movie needs all frames, and " + frames_text(job.plan.frames) +
                        " of them are missing or of other settings or inputs.",
                    "Render them first.");
    }
    for (std::size_t k = 0; k < job.plan.regions.size(); ++k) {
        warn_of_samples(job, k);
        WEFT_CHECK_OK(check_reference(job, k));
        auto scene = scene_of(job, k, planes);
        if (!scene) {
            const Shot& shot = job.shot();
            return fail_in(std::move(scene).error(),
                           "Region '" + shot.project.regions[shot.region_index[k]]->name +
                               "' with " + shot.textures[k].path);
        }
        warn_of_gloss(job, k, *scene);
        job.setup.result.planes.push_back(scene->stats);
        job.scenes.push_back(std::move(*scene));
    }
    return {};
}

// The plane of the scene, or, where no frame is left to be rendered, the same made again.
Status export_plane(const JobRun& job) {
    if (job.spec.plane.empty()) return {};
    PlanePyramid plane;
    if (!job.scenes.empty()) {
        plane = job.scenes.front().plane;
    } else {
        WEFT_TRY(made, make_plane(job.plan, job.plan.regions.front(), job.shot().source->size(),
                                  job.cancel, {}, job.setup.backend.get()));
        plane = made.pyramid;
    }
    WriteOptions write = job.setup.write;
    write.rule = job.setup.plane_rule;
    return write_plane_file(job.spec.plane, plane, job.shot().spaces, write);
}

Status export_composites(const JobRun& job) {
    return write_composites(job.spec.composites, job.setup.composite_sources(), job.scenes,
                            job.setup.write, job.setup.composite_rules);
}

// ---- frames ----------------------------------------------------------------------------------

Status frame_stage(JobRun& job, std::int64_t& done) {
    const bool movie = job.spec.stage != JobStage::kFrames;
    JobResult& result = job.setup.result;
    if (movie) result.movie = job.shot().project.output.movie;
    return render_frames({job.setup, job.plan, *job.store, job.scenes}, result.movie, job.cancel,
                         job.progress, result.frames, done);
}

// ---- warnings at the end -----------------------------------------------------------------------

void add_warnings(JobRun& job) {
    JobResult& result = job.setup.result;
    if (const std::vector<int> cuts = job.shot().cuts->cuts(); !cuts.empty()) {
        result.warnings.push_back("A new scene seems to begin at " + frames_text(cuts) +
                                  ". Surfaces are not tracked across a cut. Render each scene "
                                  "separately, with a reference frame in each" +
                                  by({{setting::kFrames}, {setting::kReferenceFrame}}) + ".");
    }
    for (const LightReport& light : result.lights)
        if (const auto warning = unsure_light_warning(light)) result.warnings.push_back(*warning);
    const bool some_touched =
        std::any_of(result.frames.begin(), result.frames.end(),
                    [](const FrameResult& f) { return !f.untouched && !f.skipped; });
    if (!some_touched) job.empty_references.clear();
    for (const std::vector<std::string>& lines :
         {job.empty_references, warnings_of(result.frames, job.shot().project),
          job.setup.backend->remarks(), job.store->remarks()}) {
        result.warnings.insert(result.warnings.end(), lines.begin(), lines.end());
    }
}

std::int64_t peak_rss_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

Status run_stages(JobRun& job, Clock::time_point start, std::int64_t& frames_done) {
    JobResult& result = job.setup.result;
    WEFT_CHECK_OK(open_caches(job));
    result.seconds.open = seconds_since(start);
    const auto work = Clock::now();
    const JobStage stage = job.spec.stage;
    if (stage == JobStage::kMotion) return motion_stage(job);
    std::optional<PlanesAhead> planes;
    grow_planes_ahead(job, planes);
    WEFT_CHECK_OK(timed(result.seconds.analyse, [&] { return analysis_stage(job); }));
    WEFT_TRY(forms, form_reports(job.shot(), *job.store));
    result.forms = std::move(forms);
    WEFT_TRY(lights, light_reports(job.shot(), *job.store, job.plan.frames));
    result.lights = std::move(lights);
    WEFT_CHECK_OK(timed(result.seconds.synthesise, [&] { return plane_stage(job, planes); }));
    WEFT_CHECK_OK(export_plane(job));
    if (stage == JobStage::kAnalyse || stage == JobStage::kPlanes) return {};
    WEFT_CHECK_OK(timed(result.seconds.render, [&] { return frame_stage(job, frames_done); }));
    WEFT_CHECK_OK(export_composites(job));
    result.fps = static_cast<double>(job.plan.frames.size()) / std::max(1e-9, seconds_since(work));
    result.seconds.total = seconds_since(start);
    add_warnings(job);
    result.peak_rss_bytes = peak_rss_bytes();
    return {};
}

// State of a failed run.
struct Attempt {
    std::shared_ptr<const Shot> shot;  // null if it was not opened
    std::int64_t frames_done = 0;
};

Expected<JobResult> attempt_job(const JobSpec& spec, const std::vector<int>& leave_out,
                                const CancelToken& cancel, const ProgressFn& progress,
                                Attempt& attempt) {
    const auto start = Clock::now();
    WEFT_TRY(setup, set_up_job(spec, leave_out, attempt.shot));
    ShotPlan plan = setup.plan;
    JobRun job{spec, cancel, progress, std::move(setup), std::move(plan), nullptr, {}, {}};
    WEFT_CHECK_OK(run_stages(job, start, attempt.frames_done));
    job.setup.result.changed_inputs = job.shot().inputs->changed();
    return std::move(job.setup.result);
}

}  // namespace

// A picture of 3840x2160 has 25 to 100 MB, and glibc returns blocks of more than 32 MB to the
// system at once: 12 % of the time of a render went into getting zeroed pages again and again. The
// peak of such a render grows by up to 17 % (1.40 to 1.64 GB, with 12 frames as with 40). Arenas of
// threads have no blocks of more than 64 MB, whatever the threshold; so there is one arena for all.
void keep_freed_memory() {
#ifdef __GLIBC__
    constexpr int kLargest_bytes = 1 << 30, kUnused_bytes = 512 << 20;
    mallopt(M_MMAP_THRESHOLD, kLargest_bytes);
    mallopt(M_TRIM_THRESHOLD, kUnused_bytes);
    mallopt(M_ARENA_MAX, 1);
#endif
}

Expected<JobStage> parse_job_stage(const std::string& name) {
    static const std::map<std::string, JobStage> kNames{
        {"all", JobStage::kAll},         {"motion", JobStage::kMotion},
        {"analyse", JobStage::kAnalyse}, {"planes", JobStage::kPlanes},
        {"frames", JobStage::kFrames},   {"encode", JobStage::kEncode}};
    const auto at = kNames.find(name);
    if (at != kNames.end()) return at->second;
    return fail(ErrorCode::kUsage, "Unknown stage '" + name + "'.",
                "Choose motion, analyse, planes, frames, encode or all.");
}

Expected<BackendChoice> choose_backend(const std::string& name) {
    BackendRegistry registry;
    register_cuda(registry);
    return registry.choose(name);
}

void make_libraries_deterministic() {
    // Debian's OpenCV uses FMA for blurs, derivatives and scaling of floats if the processor has
    // AVX2, which changes the bits.
    cv::setUseOptimized(false);
}

void use_threads(int threads) {
    make_libraries_deterministic();
    set_thread_count(threads);
    cv::setNumThreads(thread_count());
}

Expected<JobResult> run_job(const JobSpec& spec, const CancelToken& cancel,
                            const ProgressFn& progress) {
    if (spec.memory_bytes <= 0) keep_freed_memory();
    Attempt first;
    auto result = attempt_job(spec, {}, cancel, progress, first);
    if (result || result.error().code != ErrorCode::kUnreadable || !first.shot ||
        first.frames_done > 0)
        return result;
    // Frames used only for measurement may still be incomplete: retry without them.
    const std::vector<int> unreadable = unreadable_evidence(*first.shot);
    if (unreadable.empty()) return result;
    Attempt second;
    return attempt_job(spec, unreadable, cancel, progress, second);
}

Expected<JobResult> check_job(const JobSpec& spec) {
    std::shared_ptr<const Shot> shot;
    WEFT_TRY(setup, set_up_job(spec, {}, shot, OutputFolders::kLeave));
    return std::move(setup.result);
}

}  // namespace weft

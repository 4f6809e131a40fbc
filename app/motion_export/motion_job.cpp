#include "app/motion_export/motion_job.h"

#include <filesystem>
#include <mutex>

#include "app/cache/stage_cache.h"
#include "app/exchange/track_file.h"
#include "app/motion_export/motion_frames.h"
#include "app/motion_export/motion_manifest.h"
#include "app/motion_export/motion_mesh.h"
#include "app/motion_export/motion_shapes.h"
#include "app/render/existing_frames.h"
#include "app/render/job_frames.h"
#include "app/shot/frame_plan.h"
#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/media/atomic_file.h"
#include "engine/motion/corner_track_text.h"
#include "engine/pipeline/analyse.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/sweep.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// A job, and what its steps have found so far.
struct MotionRun {
    const MotionJobSpec& spec;
    const CancelToken& cancel;
    const ProgressFn& progress;
    std::shared_ptr<const Shot> shot;
    MotionPlan motion;
    std::vector<MotionPaths> paths;
    std::shared_ptr<AnalysisCache> store;
    std::vector<std::unique_ptr<RegionMotion>> surfaces;
    WriteRule rule;
    MotionManifest manifest;
    MotionJobResult result;

    [[nodiscard]] std::string path_of(const std::string& relative) const {
        return (fs::path(spec.folder) / relative).string();
    }
};

Status open_job(MotionRun& job) {
    OpenShotOptions options;
    options.textures = false;
    options.watch_inputs = true;
    options.files = open_fingerprints(job.spec.cache);
    WEFT_TRY(shot, open_shot(job.spec.project, options));
    job.shot = std::move(shot);
    job.result.notes = job.shot->notes;
    job.result.warnings = job.shot->warnings;
    WEFT_TRY(motion, plan_motion(job.spec, *job.shot));
    job.motion = std::move(motion);
    job.paths = motion_paths(job.spec, job.motion.regions);
    WEFT_TRY(fence, make_fence(job.spec.project, job.spec.limits));
    job.rule.fence = fence;
    job.rule.existing = existing_by(job.spec.existing != ExistingFrames::kRefuse);
    return check_motion_files(job.spec, job.motion, job.paths, job.rule);
}

Status analyse(MotionRun& job) {
    const Shot& shot = *job.shot;
    WEFT_TRY(store, open_analysis_cache(shot, job.spec.cache, job.result.warnings));
    job.store = std::move(store);
    ShotPlan& plan = job.motion.plan;
    if (const std::string root = cache_root(job.spec.cache); job.spec.cache.keep && !root.empty())
        plan.stages = open_stage_cache(shot, root);
    WEFT_CHECK_OK(analyse_shot(*shot.source, plan, *job.store, job.cancel, job.progress));
    for (const MotionRegion& region : job.motion.regions)
        job.surfaces.push_back(
            std::make_unique<RegionMotion>(*shot.source, plan, *job.store, region.index));
    return {};
}

// Frames of the shot that show a region, for a message.
std::string frames_with(const MotionRun& job, std::size_t k) {
    std::vector<int> out;
    for (const int frame : job.motion.frames) {
        const auto visible = job.surfaces[k]->visible(job.shot->plate->shown_frame(frame));
        if (visible && !matte_bounds(*visible).empty() && !shows_black(*job.shot, frame))
            out.push_back(frame);
    }
    return out.empty() ? std::string() : frames_text(out);
}

Status check_references(const MotionRun& job) {
    for (std::size_t k = 0; k < job.surfaces.size(); ++k) {
        const MotionRegion& region = job.motion.regions[k];
        WEFT_TRY(visible, job.surfaces[k]->visible(job.shot->plate->shown_frame(region.reference)));
        if (!matte_bounds(visible).empty() && !shows_black(*job.shot, region.reference)) continue;
        const std::string others = frames_with(job, k);
        return fail(ErrorCode::kUsage,
                    "The reference frame " + std::to_string(region.reference) +
                        " shows nothing of region '" + region.name + "'.",
                    others.empty() ? "No frame of the export shows it; check its matte."
                                   : "Choose a reference frame among " + others + ".");
    }
    return {};
}

Status write_manifest(MotionRun& job, bool complete) {
    job.manifest.complete = complete;
    job.result.manifest = manifest_text(job.manifest);
    WriteRule rule = job.rule;
    // The one that was written before the pictures is this run's own.
    if (complete) rule.existing = Existing::kReplace;
    return write_file_atomically(job.path_of(kMotionManifest), job.result.manifest, rule);
}

// The corners on every frame of the export, held frames as the frames that they repeat.
Expected<RegionCorners> corners_of(const MotionRun& job, std::size_t k) {
    std::vector<int> shown;
    for (const int frame : job.motion.frames)
        if (!shows_black(*job.shot, frame)) shown.push_back(job.shot->plate->shown_frame(frame));
    const int reference = job.motion.regions[k].reference;
    const int reference_shown = job.shot->plate->shown_frame(reference);
    shown.push_back(reference_shown);
    std::sort(shown.begin(), shown.end());
    shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
    WEFT_TRY(corners, region_corners(*job.surfaces[k], *job.store, reference_shown, shown));
    CornerTrack held;
    for (const int frame : job.motion.frames) {
        const auto at = corners.track.find(job.shot->plate->shown_frame(frame));
        if (at != corners.track.end()) held[frame] = at->second;
    }
    held[reference] = corners.track.at(reference_shown);
    WEFT_TRY(whole, completed(std::move(held)));
    corners.track = std::move(whole);
    return corners;
}

// A region whose surface is no plane has no corner pin, which is no error of the others.
Status write_corner_pins(MotionRun& job) {
    for (std::size_t k = 0; k < job.paths.size(); ++k) {
        const MotionRegion& region = job.motion.regions[k];
        MotionPaths& paths = job.paths[k];
        if (paths.track.empty()) continue;
        if (job.cancel.cancelled()) return cancelled(job.cancel);
        auto corners = corners_of(job, k);
        if (!corners && corners.error().code != ErrorCode::kRenderFailed)
            return fail_in(std::move(corners).error(), "Region '" + region.name + "'");
        if (!corners) {
            job.result.warnings.push_back("Region '" + region.name +
                                          "' has no corner pin: " + corners.error().sentence());
            continue;
        }
        CornerTextContext context;
        context.plate = job.shot->plate->size();
        context.first_frame = job.shot->plate->frames().front();
        context.reference = region.reference;
        context.fps = job.manifest.fps;
        context.pixel_aspect = job.shot->plate->pixel_aspect();
        const CornerTrack& track = corners->track;
        for (const auto& [path, text] :
             {std::pair(paths.nuke, nuke_corner_pin(track, context)),
              {paths.after_effects, after_effects_corner_pin(track, context)},
              {paths.blender, blender_corner_pin(track, context)}})
            WEFT_CHECK_OK(write_file_atomically(job.path_of(path), text, job.rule));
        WEFT_CHECK_OK(write_corner_track(job.path_of(paths.track), track, job.rule));
        job.manifest.regions[k].corners = std::move(*corners);
    }
    return {};
}

Status make_folders(const MotionRun& job) {
    for (const MotionPaths& paths : job.paths) {
        std::vector<std::string> files{paths.st_map, paths.stabilize, paths.track, paths.mlt_shapes,
                                       paths.mesh_obj};
        for (const auto& [convention, path] : paths.vectors)
            files.push_back(path);
        for (const std::string& file : files) {
            if (file.empty()) continue;
            WEFT_CHECK_OK(make_folder_of(job.path_of(file), job.rule));
            remove_stale_temporaries(job.path_of(file));
        }
    }
    return make_folder(job.spec.folder, job.rule);
}

// Roto shapes and meshes. A region that cannot have them is no error of the others.
Status write_outlines_and_meshes(MotionRun& job) {
    for (std::size_t k = 0; k < job.paths.size(); ++k) {
        const MotionRegion& region = job.motion.regions[k];
        const MotionFramesInputs in{job.spec,     *job.shot,        job.motion, region,
                                    job.paths[k], *job.surfaces[k], job.rule};
        const auto keep = [&](auto made, auto& kept, const char* what) -> Status {
            if (!made && made.error().code != ErrorCode::kRenderFailed)
                return fail_in(std::move(made).error(), "Region '" + region.name + "'");
            if (made)
                kept = std::move(*made);
            else
                job.result.warnings.push_back("Region '" + region.name + "' has no " + what + ": " +
                                              made.error().sentence());
            return {};
        };
        if (job.cancel.cancelled()) return cancelled(job.cancel);
        MotionManifest::Entry& entry = job.manifest.regions[k];
        if (job.spec.what.shapes)
            WEFT_CHECK_OK(keep(write_motion_shapes(in), entry.shapes, "roto shapes"));
        if (job.spec.what.mesh)
            WEFT_CHECK_OK(
                keep(write_motion_mesh(in, *job.store, job.manifest.fps), entry.mesh, "mesh"));
    }
    return {};
}

// In batches, so that an error stops the work soon and is that of the first frame that has one.
Status write_pictures(MotionRun& job) {
    const std::vector<int>& frames = job.motion.frames;
    const std::size_t regions = job.paths.size(), count = frames.size() * regions;
    const std::size_t batch = 4 * static_cast<std::size_t>(thread_count());
    std::mutex mutex;
    std::int64_t done = 0;
    for (std::size_t first = 0; first < count; first += batch) {
        const std::size_t size = std::min(batch, count - first);
        WEFT_CHECK_OK(parallel_try(size, [&](std::size_t i) -> Status {
            if (job.cancel.cancelled()) return cancelled(job.cancel);
            const auto start = Clock::now();
            const int frame = frames[(first + i) / regions];
            const std::size_t k = (first + i) % regions;
            auto made = write_motion_frame({job.spec, *job.shot, job.motion, job.motion.regions[k],
                                            job.paths[k], *job.surfaces[k], job.rule},
                                           frame);
            if (!made) return fail_in(std::move(made).error(), "Frame " + std::to_string(frame));
            const std::lock_guard lock(mutex);
            job.result.written += made->written;
            job.result.kept += made->kept;
            ++done;
            if (job.progress)
                job.progress({WorkStage::kExport, done, static_cast<std::int64_t>(count), frame,
                              seconds_since(start)});
            return {};
        }));
    }
    return {};
}

}  // namespace

Expected<MotionJobResult> run_motion_job(const MotionJobSpec& spec, const CancelToken& cancel,
                                         const ProgressFn& progress) {
    use_threads(spec.threads);
    keep_freed_memory();
    MotionRun job{spec, cancel, progress, {}, {}, {}, {}, {}, {}, {}, {}};
    WEFT_CHECK_OK(open_job(job));
    WEFT_CHECK_OK(analyse(job));
    WEFT_CHECK_OK(check_references(job));
    job.manifest.size = job.shot->plate->size();
    job.manifest.fps = movie_fps(*job.shot);
    job.manifest.frames = job.motion.frames;
    job.manifest.st = spec.st;
    for (std::size_t k = 0; k < job.paths.size(); ++k)
        job.manifest.regions.push_back({job.motion.regions[k], job.paths[k], {}, {}});
    WEFT_CHECK_OK(make_folders(job));
    WEFT_CHECK_OK(write_manifest(job, false));
    WEFT_CHECK_OK(write_corner_pins(job));
    WEFT_CHECK_OK(write_outlines_and_meshes(job));
    WEFT_CHECK_OK(write_pictures(job));
    WEFT_CHECK_OK(check_unchanged(job.shot->inputs->changed()));
    WEFT_CHECK_OK(write_manifest(job, true));
    const std::vector<std::string> remarks = job.store->remarks();
    job.result.warnings.insert(job.result.warnings.end(), remarks.begin(), remarks.end());
    return std::move(job.result);
}

}  // namespace weft

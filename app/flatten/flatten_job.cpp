#include "app/flatten/flatten_job.h"

#include <algorithm>

#include "app/cache/stage_cache.h"
#include "app/exchange/flat_picture.h"
#include "app/flatten/flat_file.h"
#include "app/flatten/flat_plan.h"
#include "app/render/job_frames.h"
#include "app/render/recipe.h"
#include "app/render/render_job.h"
#include "engine/core/parallel.h"
#include "engine/media/atomic_file.h"
#include "engine/pipeline/analyse.h"
#include "engine/pipeline/flat_surface.h"

namespace weft {
namespace {

constexpr int kWidestDoubled_px = 2048;
constexpr std::uint8_t kFewFrames = 2;

// A job, and what its steps have found so far.
struct FlatRun {
    const FlattenSpec& spec;
    const CancelToken& cancel;
    const ProgressFn& progress;
    std::shared_ptr<const Shot> shot;
    FlatPlan flat;
    std::shared_ptr<AnalysisCache> store;
    std::shared_ptr<const Backend> backend;
    WriteRule rule;
    FlattenResult result;

    [[nodiscard]] const RegionPlan& region() const { return region_of(flat.plan, flat.region); }
};

// The margin that a picture of the plate may have (flat_layout_of()).
Status check_margin(const FlattenSpec& spec, Size plate) {
    const int margin = spec.margin_px.value_or(0);
    if (margin >= 0 && 2 * margin < plate.width) return {};
    return fail(ErrorCode::kUsage,
                "A margin of " + std::to_string(margin) +
                    " px does not fit: it is 0 or more, and less than half the plate's width of " +
                    std::to_string(plate.width) + " px.",
                "Choose a smaller one.");
}

Status open_flat(FlatRun& run) {
    const FlattenSpec& spec = run.spec;
    WEFT_CHECK_OK(check_flat_file(spec.path));
    WEFT_TRY(fence, make_fence(spec.project, spec.limits));
    run.rule.fence = fence;
    run.rule.existing = existing_by(spec.overwrite);
    WEFT_CHECK_OK(check_output(spec.path, run.rule));
    WEFT_TRY(project, flat_project(spec));
    OpenShotOptions options;
    options.textures = is_open_raster(spec.path) && all_have_textures(project);
    options.texture_library = spec.texture_library;
    options.watch_inputs = true;
    options.files = open_fingerprints(spec.cache);
    WEFT_TRY(shot, open_shot(project, options));
    run.shot = std::move(shot);
    run.result.notes = run.shot->notes;
    run.result.warnings = run.shot->warnings;
    WEFT_CHECK_OK(check_margin(spec, run.shot->plate->size()));
    WEFT_TRY(flat, plan_flat(spec, *run.shot));
    run.flat = std::move(flat);
    run.result.frames = run.flat.frames;
    run.result.reference = run.region().reference_frames.front();
    const std::size_t index = run.shot->region_index[static_cast<std::size_t>(run.flat.region)];
    run.result.region = run.shot->project.regions[index]->name;
    return {};
}

Status analyse_flat(FlatRun& run) {
    const Shot& shot = *run.shot;
    WEFT_TRY(store, open_analysis_cache(shot, run.spec.cache, run.result.warnings));
    run.store = std::move(store);
    ShotPlan& plan = run.flat.plan;
    if (const std::string root = cache_root(run.spec.cache); run.spec.cache.keep && !root.empty())
        plan.stages = open_stage_cache(shot, root);
    return analyse_shot(*shot.source, plan, *run.store, run.cancel, run.progress);
}

Expected<RegionScene> scene_of(FlatRun& run) {
    WEFT_TRY(choice, choose_backend("cpu"));
    run.backend = choice.backend;
    std::optional<RegionPlane> none;
    if (!run.flat.has_texture)
        none = RegionPlane{PlanePyramid(ImageF3(1, 1), WrapMode::kRepeat), {}, {}, nullptr};
    return make_scene(*run.shot->source, run.flat.plan, *run.store, run.flat.region, run.cancel,
                      run.progress, run.backend.get(), std::move(none));
}

Status choose_layout(FlatRun& run, const FlatInputs& inputs) {
    FlatLayout& layout = run.result.layout;
    layout.plate = run.shot->plate->size();
    layout.texels_per_px = run.spec.scale > 0                        ? run.spec.scale
                           : layout.plate.width <= kWidestDoubled_px ? kMostFlatScale
                                                                     : 1;
    if (run.spec.margin_px) {
        layout.margin_px = *run.spec.margin_px;
        return {};
    }
    WEFT_TRY(margin, flat_margin(inputs, run.cancel));
    layout.margin_px = margin;
    return {};
}

// The region's texture, graded, where a render would show it on the reference frame.
Expected<ImageF3> laid_texture(const FlatRun& run, const RegionScene& scene,
                               const Matte& coverage) {
    WEFT_TRY(mapping, mapping_on(run.region(), scene, run.result.reference));
    const FlatLayout& layout = run.result.layout;
    const auto scale = static_cast<float>(layout.texels_per_px);
    const auto margin = static_cast<float>(layout.margin_px);
    ImageF2 coords(coverage.size());
    parallel_rows(coords.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < coords.width(); ++x) {
                const Vec2 u = mapping.texel({(static_cast<float>(x) + 0.5f) / scale - margin,
                                              (static_cast<float>(y) + 0.5f) / scale - margin});
                coords.pixel(x, y)[0] = u.x, coords.pixel(x, y)[1] = u.y;
            }
        }
    });
    ImageF3 out(coverage.size());
    SampleRequest request;
    request.plane = &scene.plane;
    request.coords = coords;
    request.matte = coverage;
    run.backend->sample_plane(request, out);
    apply_grade(out, coverage, grade_on(run.region(), scene));
    return out;
}

void note_coverage(const FlatSurface& surface, FlattenResult& result) {
    std::int64_t covered = 0, few = 0;
    for (std::size_t k = 0; k < surface.coverage.size_bytes(); ++k) {
        covered += surface.coverage.data()[k] > 0 ? 1 : 0;
        few += surface.coverage.data()[k] > 0 && surface.frames.data()[k] <= kFewFrames ? 1 : 0;
    }
    result.covered =
        static_cast<double>(covered) / static_cast<double>(surface.coverage.size_bytes());
    result.few_frames = covered > 0 ? static_cast<double>(few) / static_cast<double>(covered) : 0;
}

// What a file of integers cannot hold.
void warn_of_white(const FlatRun& run, const FlatSurface& surface,
                   std::vector<std::string>& warnings) {
    if (run.spec.path.ends_with(".exr")) return;
    std::int64_t above = 0;
    for (int y = 0; y < surface.colour.height(); ++y) {
        for (int x = 0; x < surface.colour.width(); ++x) {
            const float* p = surface.colour.pixel(x, y);
            if (surface.coverage.at(x, y) > 0 && std::max({p[0], p[1], p[2]}) > 1.0f) ++above;
        }
    }
    if (above == 0) return;
    warnings.push_back("Without its light the surface is brighter than white in " +
                       std::to_string(above) +
                       " texels, which end at white in this file. Write .exr to keep them.");
}

}  // namespace

Expected<FlattenResult> run_flatten(const FlattenSpec& spec, const CancelToken& cancel,
                                    const ProgressFn& progress) {
    use_threads(spec.threads);
    keep_freed_memory();
    FlatRun run{spec, cancel, progress, {}, {}, {}, {}, {}, {}};
    WEFT_CHECK_OK(open_flat(run));
    WEFT_CHECK_OK(analyse_flat(run));
    WEFT_TRY(scene, scene_of(run));
    const FlatInputs inputs{*run.shot->source, run.flat.plan,  *run.store, run.flat.region, scene,
                            *run.backend,      run.flat.frames};
    WEFT_CHECK_OK(choose_layout(run, inputs));
    WEFT_TRY(surface, gather_flat_surface(inputs, run.result.layout, cancel, progress));
    note_coverage(surface, run.result);
    warn_of_white(run, surface, run.result.warnings);
    ImageF3 texture;
    if (run.flat.has_texture) {
        WEFT_TRY(laid, laid_texture(run, scene, surface.coverage));
        texture = std::move(laid);
    }
    WEFT_CHECK_OK(check_unchanged(run.shot->inputs->changed()));
    WriteOptions write;
    write.rule = run.rule;
    // The picture lies on the plate's own pixels.
    write.pixel_aspect = run.shot->plate->pixel_aspect();
    write.metadata = recipe_metadata(*run.shot, run.backend->name());
    WEFT_CHECK_OK(make_folder_of(spec.path, run.rule));
    WEFT_TRY(layers, write_flat_file(spec.path, {surface, texture.empty() ? nullptr : &texture},
                                     run.shot->spaces, write));
    run.result.layers = std::move(layers);
    const std::vector<std::string> remarks = run.store->remarks();
    run.result.warnings.insert(run.result.warnings.end(), remarks.begin(), remarks.end());
    return std::move(run.result);
}

}  // namespace weft

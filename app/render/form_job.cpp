#include "app/render/form_job.h"

#include <set>

#include "app/cache/stage_cache.h"
#include "engine/core/setting.h"
#include "engine/pipeline/analyse.h"
#include "engine/pipeline/partial_plan.h"
#include "engine/pipeline/region_form.h"

namespace weft {
namespace {

// Nothing of a region's analysis but what its form needs.
void keep_form_only(RegionPlan& region) {
    leave_look_out(region);
    if (!region.has_form()) leave_region_out(region);
}

// The plan of a shot that is to be followed as far as its forms need.
ShotPlan form_plan(const ShotPlan& shot) {
    ShotPlan plan = shot;
    std::set<int> references;
    for (RegionPlan& region : plan.regions) {
        keep_form_only(region);
        references.insert(region.reference_frames.front());
    }
    plan.frames.assign(references.begin(), references.end());
    return plan;
}

// A shot whose forms were found.
struct Found {
    std::shared_ptr<const Shot> shot;
    std::shared_ptr<AnalysisCache> store;
};

Expected<Found> find(const JobSpec& spec, const CancelToken& cancel, const ProgressFn& progress,
                     std::vector<std::string>& warnings) {
    OpenShotOptions options;
    options.textures = false;
    options.watch_inputs = true;
    options.files = open_fingerprints(spec.cache);
    WEFT_TRY(shot, open_shot(spec.project, options));
    if (shot->plan.regions.empty()) {
        return fail(ErrorCode::kUsage, "The project has no region.",
                    "Add one with a matte" + by({{setting::kAddRegion}}) + ".");
    }
    WEFT_TRY(store, open_analysis_cache(*shot, spec.cache, warnings));
    ShotPlan plan = form_plan(shot->plan);
    if (const std::string root = cache_root(spec.cache); spec.cache.keep && !root.empty())
        plan.stages = open_stage_cache(*shot, root);
    WEFT_CHECK_OK(analyse_shot(*shot->source, plan, *store, cancel, progress));
    return Found{std::move(shot), std::move(store)};
}

}  // namespace

Expected<FormJobResult> run_form_job(const JobSpec& spec, const CancelToken& cancel,
                                     const ProgressFn& progress) {
    use_threads(spec.threads);
    FormJobResult out;
    WEFT_TRY(found, find(spec, cancel, progress, out.warnings));
    out.notes = found.shot->notes;
    out.warnings.insert(out.warnings.begin(), found.shot->warnings.begin(),
                        found.shot->warnings.end());
    WEFT_TRY(forms, form_reports(*found.shot, *found.store));
    WEFT_CHECK_OK(check_unchanged(found.shot->inputs->changed()));
    out.forms = std::move(forms);
    const std::vector<std::string> remarks = found.store->remarks();
    out.warnings.insert(out.warnings.end(), remarks.begin(), remarks.end());
    return out;
}

Expected<std::shared_ptr<const SurfaceForm>> find_laid_form(const JobSpec& spec,
                                                            const CancelToken& cancel,
                                                            std::vector<std::string>& warnings) {
    WEFT_TRY(found, find(spec, cancel, {}, warnings));
    return region_form(found.shot->plan.regions.front(), *found.store, 0);
}

}  // namespace weft

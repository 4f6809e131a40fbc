#include "engine/pipeline/surface_job.h"

#include <cstdlib>

#include "engine/pipeline/region_mattes.h"

namespace weft {

namespace {

// What lies around a zone is followed as a surface of its own.
SurfaceJob surroundings_of(const SurfaceJob& surface, int zone) {
    SurfaceJob job;
    job.region = surface.region;
    job.layer = zone_layer(zone);
    job.plan = surface.plan;
    job.span = surface.span;
    job.primary = surface.primary;
    job.references = {surface.primary};
    job.coords = true;
    return job;
}

}  // namespace

std::vector<SurfaceJob> surface_jobs(const ShotPlan& plan, const AnalysisStore& store) {
    std::vector<SurfaceJob> jobs;
    for (std::size_t k = 0; k < plan.regions.size(); ++k) {
        const RegionPlan& region = plan.regions[k];
        SurfaceJob job;
        job.region = static_cast<int>(k);
        job.plan = &region;
        job.span = analysed_span(plan, region);
        job.references = region.reference_frames;
        job.primary = job.references.front();
        std::sort(job.references.begin(), job.references.end());
        job.coords = region.temporal == TemporalMode::kLocked;
        // Further references anchor coordinates only.
        if (!job.coords) job.references = {job.primary};
        job.paper = region.temporal == TemporalMode::kPaper;
        job.shading = region.estimates_light();
        job.grain = region.grain > 0 && !region.grain_frames.empty();
        job.shutter = region.estimates_shutter();
        for (int zone = 0; job.coords && zone < static_cast<int>(region.zones.size()); ++zone) {
            if (region.zones[static_cast<std::size_t>(zone)].kind != ZoneKind::kSurroundings)
                continue;
            SurfaceJob around = surroundings_of(job, zone);
            if (!around.complete(store)) jobs.push_back(std::move(around));
        }
        if ((job.coords || job.paper || job.shading || job.grain || job.shutter) &&
            !job.complete(store)) {
            jobs.push_back(std::move(job));
        }
    }
    return jobs;
}

SurfaceLegs surface_legs(const std::vector<SurfaceJob>& jobs) {
    SurfaceLegs legs;
    const auto widen = [](std::optional<SweepOptions>& leg, int first, int last, bool motion) {
        if (!leg) {
            leg = SweepOptions{first, last, motion};
            return;
        }
        const bool up = last >= first;
        leg->first = up ? std::min(leg->first, first) : std::max(leg->first, first);
        leg->last = up ? std::max(leg->last, last) : std::min(leg->last, last);
        leg->motion |= motion;
    };
    for (const SurfaceJob& job : jobs) {
        const bool motion = !job.plan->true_motion && job.plan->track.empty();
        widen(legs.forward, job.primary, job.span.last, motion);
        if (job.span.first < job.primary || job.references.back() > job.primary) {
            widen(legs.backward, job.references.back(), job.span.first, motion);
        }
        if (job.references.front() < job.primary) {
            widen(legs.again, job.references.front(), job.primary, motion);
        }
    }
    return legs;
}

int SurfaceLegs::steps() const {
    int sum = 0;
    for (const std::optional<SweepOptions>& leg : {forward, backward, again})
        if (leg) sum += std::abs(leg->last - leg->first) + 1;
    return sum;
}

}  // namespace weft

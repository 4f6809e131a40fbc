#include "engine/pipeline/surface_stop.h"

#include <utility>

#include "engine/core/parallel.h"
#include "engine/pipeline/motion_zones.h"

namespace weft {

bool visits(const SurfaceJob& job, SurfaceLeg leg, int frame) {
    switch (leg) {
        case SurfaceLeg::kForward:
            return frame >= job.primary && frame <= job.span.last;
        case SurfaceLeg::kBackward:
            return frame <= job.references.back() && frame >= job.span.first;
        case SurfaceLeg::kAgain:
            return frame >= job.references.front() && frame < job.primary;
    }
    return false;
}

bool begins(const SurfaceJob& job, SurfaceLeg leg, int frame) {
    switch (leg) {
        case SurfaceLeg::kForward:
            return frame == job.primary;
        case SurfaceLeg::kBackward:
            return frame >= job.primary && job.is_reference(frame);
        case SurfaceLeg::kAgain:
            return job.is_reference(frame);
    }
    return false;
}

SurfaceStops::SurfaceStops(const PassContext& context, const AnalysisStore& store,
                           const std::vector<SurfaceJob>& jobs, SurfaceLeg leg)
    : context_(context), store_(store), jobs_(jobs), leg_(leg), before_(jobs.size()) {}

Expected<Matte> SurfaceStops::extent_of(const SurfaceJob& job, int frame) const {
    if (is_zone_layer(job.layer))
        return zone_surroundings(context_.source, context_.plan, store_, job.region,
                                 zone_of_layer(job.layer), frame);
    return extent_matte(context_.source, context_.plan, store_, job.region, frame);
}

Expected<SurfaceStop> SurfaceStops::stop_at(const SurfaceJob& job, Before& before,
                                            const SweepFrame& at) const {
    SurfaceStop out;
    WEFT_TRY(extent, extent_of(job, at.frame));
    WEFT_TRY(holdout, holdout_matte(context_.source, context_.plan, store_, job.region, at.frame));
    out.held = before.held.advance({at.views->display, extent, holdout});
    out.visible = without_holdout(extent, holdout);
    out.extent = std::move(extent);
    drop_nonfinite(out.visible, at.views->finite);
    if (motion_of(*job.plan) != SurfaceTrack::Motion::kEstimated) return out;
    const bool first = begins(job, leg_, at.frame);
    if (out.held && !first) return out;
    const StepFrame* last = first ? nullptr : before.frame.get();
    out.step = prepare_step(*at.views, out.visible, out.extent, at.prev_from_cur.get(), last,
                            context_.plan.quality);
    before.frame = out.step->frame;
    return out;
}

Status SurfaceStops::prepare(const SweepFrame& at) {
    std::vector<std::optional<SurfaceStop>> stops(jobs_.size());
    std::vector<Status> done(jobs_.size());
    for_each_job(jobs_.size(), [&](std::size_t k) {
        if (!visits(jobs_[k], leg_, at.frame)) return;
        auto stop = stop_at(jobs_[k], before_[k], at);
        if (stop)
            stops[k] = std::move(*stop);
        else
            done[k] = tl::unexpected(std::move(stop).error());
    });
    for (Status& status : done)
        WEFT_CHECK_OK(std::move(status));
    const std::lock_guard lock(mutex_);
    prepared_.push_back(std::move(stops));
    return {};
}

std::vector<std::optional<SurfaceStop>> SurfaceStops::take() {
    const std::lock_guard lock(mutex_);
    std::vector<std::optional<SurfaceStop>> oldest = std::move(prepared_.front());
    prepared_.pop_front();
    return oldest;
}

void for_each_job(std::size_t jobs, const std::function<void(std::size_t)>& one) {
    if (jobs > 1 && thread_count() <= 2 * static_cast<int>(jobs)) {
        parallel_for(jobs, one);
        return;
    }
    for (std::size_t k = 0; k < jobs; ++k)
        one(k);
}

}  // namespace weft

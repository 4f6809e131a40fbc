#include "engine/pipeline/surface_stop.h"

#include <algorithm>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/pipeline/motion_zones.h"
#include "engine/pipeline/walk_memory.h"
#include "engine/temporal/outline_evidence.h"

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

namespace {

// Threads that gather evidence of several frames side by side: inside of a step little runs in
// parallel. One for four processors; more frames on their way take more memory.
std::size_t gathering_threads(const ShotPlan& plan, Size plate) {
    if (plan.spare_memory) return 0;
    constexpr int kMost = 4;
    constexpr int kMostPixels = 24 << 20;  // of plates, about 0.5 GB
    const int by_memory = kMostPixels / std::max(1, plate.width) / std::max(1, plate.height);
    const int threads = std::min({thread_count() / 4, kMost, by_memory});
    return threads > 1 ? static_cast<std::size_t>(threads) : 0;
}

Hash128 hash_of(const PlateViews& views) {
    return Hasher().image(views.followed()).image(views.followed_display()).finish();
}

}  // namespace

SurfaceStops::SurfaceStops(const PassContext& context, const AnalysisStore& store,
                           const std::vector<SurfaceJob>& jobs, SurfaceLeg leg)
    : context_(context),
      store_(store),
      jobs_(jobs),
      leg_(leg),
      before_(jobs.size()),
      workers_(gathering_threads(context.plan, context.source.size())) {}

Expected<Matte> SurfaceStops::extent_of(const SurfaceJob& job, int frame) const {
    if (is_zone_layer(job.layer))
        return zone_surroundings(context_.source, context_.plan, store_, job.region,
                                 zone_of_layer(job.layer), frame);
    return extent_matte(context_.source, context_.plan, store_, job.region, frame);
}

// prev_from_cur from the files, which point in one direction of time. The other direction is
// inverted, using what was visible of the surface in the frame before; otherwise an occluder's
// motion would land on it.
Expected<FlowField> SurfaceStops::true_motion(const SurfaceJob& job, int frame,
                                              const Matte& visible_before) const {
    const bool back = leg_ == SurfaceLeg::kBackward;
    if (job.plan->motion_forward == back) return context_.source.motion(job.region, frame);
    WEFT_TRY(cur_from_prev, context_.source.motion(job.region, frame + (back ? 1 : -1)));
    drop_nonfinite(cur_from_prev.valid, visible_before);
    return invert_flow(cur_from_prev);
}

// The part of a step that needs the frame before, and the rest, which needs nothing else.
SurfaceStops::Gather SurfaceStops::begin_step(const SurfaceJob& job, Before& before,
                                              const SweepFrame& at, const Hash128& views,
                                              SurfaceStop& stop) const {
    const bool first = begins(job, leg_, at.frame);
    const SurfaceTrack::Motion motion = motion_of(*job.plan);
    if (motion == SurfaceTrack::Motion::kExact && !first) {
        return [this, &job, frame = at.frame, views = at.views,
                visible_before = before.visible](SurfaceStop& s) -> Status {
            WEFT_TRY(flow, true_motion(job, frame, visible_before));
            s.step = exact_step(*views, s.visible, flow);
            return {};
        };
    }
    if (motion != SurfaceTrack::Motion::kEstimated || (stop.held && !first)) return {};
    WalkMemory* const walks = context_.plan.walks.get();
    if (walks) stop.key = before.key = key_of(before, views, stop, first);
    const auto prev = first ? nullptr : std::exchange(before.frame, nullptr);
    if (walks) stop.step = walks->find_step(before.key);
    if (stop.step) {
        before.frame = stop.step->frame;
        return {};
    }
    before.frame = step_frame(*at.views, stop.visible, stop.extent, prev.get());
    stop.step = WalkStep{before.frame, {}};
    return [prev, motion = at.prev_from_cur, quality = context_.plan.motion_quality,
            walks = context_.plan.keep_walks ? walks : nullptr, key = before.key, frame = at.frame,
            previous = before.number, asks_outline = job.asks_outline](SurfaceStop& s) {
        static_cast<void>(s.step->frame->picture());  // the walk registers it
        if (prev && motion) {
            StepEvidence& evidence = s.step->evidence;
            evidence = step_evidence(prev, s.step->frame, {motion, &motion->get()}, quality);
            // Only when it is found depends on where the walk is, not what is found.
            if (evidence.open && *asks_outline) static_cast<void>(evidence.open->whole());
        }
        if (walks && (!prev || motion)) walks->keep_step(key, frame, previous, *s.step);
        return Status{};
    };
}

// Names a step by all that it depends on: what it begins with is named by the step before, whose
// colours are followed, too.
Hash128 SurfaceStops::key_of(const Before& before, const Hash128& views, const SurfaceStop& stop,
                             bool first) const {
    Hasher hasher;
    if (!first) {
        for (const Hash128& h : {before.key, before.views})
            hasher.value(h.high).value(h.low);
    }
    return hasher.value(views.high)
        .value(views.low)
        .image(stop.visible)
        .image(stop.extent)
        .value(static_cast<int>(context_.plan.motion_quality))
        .finish();
}

Expected<SurfaceStop> SurfaceStops::begin_stop(const SurfaceJob& job, Before& before,
                                               const SweepFrame& at, const Hash128& views,
                                               Gather& gather) const {
    SurfaceStop out;
    // Mattes go with the picture by which the surface is followed.
    const bool estimated = motion_of(*job.plan) == SurfaceTrack::Motion::kEstimated;
    const int seen = estimated ? at.seen : at.frame;
    WEFT_TRY(extent, extent_of(job, seen));
    WEFT_TRY(holdout, holdout_matte(context_.source, context_.plan, store_, job.region, seen));
    out.held = before.held.advance({at.views->display, extent, holdout});
    out.visible = without_holdout(extent, holdout);
    out.extent = std::move(extent);
    drop_nonfinite(out.visible, at.views->finite);
    gather = begin_step(job, before, at, views, out);
    before.visible = out.visible;
    before.number = at.frame;
    before.views = views;
    return out;
}

Status SurfaceStops::prepare(const SweepFrame& at) {
    const auto stops = std::make_shared<Stops>(jobs_.size());
    const auto gather = std::make_shared<std::vector<Gather>>(jobs_.size());
    const Hash128 views = context_.plan.walks ? hash_of(*at.views) : Hash128();
    WEFT_CHECK_OK(parallel_try(jobs_.size(), [&](std::size_t k) -> Status {
        if (!visits(jobs_[k], leg_, at.frame)) return {};
        WEFT_TRY(stop, begin_stop(jobs_[k], before_[k], at, views, (*gather)[k]));
        (*stops)[k] = std::move(stop);
        return {};
    }));
    const auto finish = [stops, gather]() -> Expected<Stops> {
        WEFT_CHECK_OK(parallel_try(stops->size(), [&](std::size_t k) {
            return (*gather)[k] ? (*gather)[k](*(*stops)[k]) : Status{};
        }));
        return std::move(*stops);
    };
    std::future<Expected<Stops>> coming;
    if (workers_.empty()) {
        std::promise<Expected<Stops>> made;
        made.set_value(finish());
        coming = made.get_future();
    } else {
        coming = workers_[turn_++ % workers_.size()].run(finish);
    }
    const std::lock_guard lock(mutex_);
    prepared_.push_back(std::move(coming));
    return {};
}

Expected<SurfaceStops::Stops> SurfaceStops::take() {
    std::future<Expected<Stops>> oldest;
    {
        const std::lock_guard lock(mutex_);
        oldest = std::move(prepared_.front());
        prepared_.pop_front();
    }
    return oldest.get();
}

}  // namespace weft

#include "engine/pipeline/matte_pass.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "engine/pipeline/matte_join.h"
#include "engine/pipeline/matte_stop.h"
#include "engine/pipeline/matte_stretch.h"
#include "engine/pipeline/region_zones.h"

namespace weft {
namespace {

using Job = MatteStretch;

bool overlap(FrameSpan a, FrameSpan b) {
    return a.first <= b.last && b.first <= a.last;
}

// Adds the stretches of a region that `wanted` holds for and that are not complete. Holdouts come
// first, with all that the others need of them.
template <class Wanted>
void add_jobs(const ShotPlan& plan, const AnalysisStore& store, std::size_t k, Wanted&& wanted,
              std::vector<Job>& jobs) {
    const RegionPlan& region = plan.regions[k];
    const FrameSpan span = analysed_span(plan, region);
    std::vector<Job> behind;
    const auto add = [&](int layer, const PaintedMatte& painted, auto&& also,
                         std::vector<Job>& to) {
        const auto missing = [&](const Job& job) {
            for (int f = job.own.first; f <= job.own.last; ++f)
                if (!store.has({job.region, f, AnalysisKind::kMatte, job.layer})) return true;
            return false;
        };
        for (Job& job : stretches(static_cast<int>(k), layer, painted, span))
            if ((wanted(job) || also(job)) && missing(job)) to.push_back(std::move(job));
    };
    const auto no_other = [](const Job&) { return false; };
    if (region.propagated())
        add(0,
            {region.matte_keys,
             region.matte_steadiness,
             region.matte_reach,
             {},
             region.matte_confirmed},
            no_other, behind);
    for (int zone = 0; zone < static_cast<int>(region.zones.size()); ++zone)
        if (const ZonePlan& planned = region.zones[static_cast<std::size_t>(zone)];
            planned.propagated())
            add(zone_layer(zone), planned.painted, no_other, behind);
    const auto needed = [&](const Job& holdout) {
        return std::any_of(behind.begin(), behind.end(),
                           [&](const Job& job) { return overlap(job.needed(), holdout.own); });
    };
    int layer = 0;
    for (const PaintedMatte& holdout : region.painted_holdouts)
        add(++layer, holdout, needed, jobs);
    std::move(behind.begin(), behind.end(), std::back_inserter(jobs));
}

template <class Wanted>
std::vector<Job> jobs_of(const ShotPlan& plan, const AnalysisStore& store, Wanted&& wanted) {
    std::vector<Job> jobs;
    for (std::size_t k = 0; k < plan.regions.size(); ++k)
        add_jobs(plan, store, k, wanted, jobs);
    return jobs;
}

// Whether each frame's holdouts are final when the mattes behind them come to it in the same walk:
// then one walk is enough. That does not depend on what is stored, nor do the mattes.
bool known_in_time(const std::vector<Job>& jobs) {
    return std::all_of(jobs.begin(), jobs.end(), [&](const Job& holdout) {
        if (!holdout.in_front()) return true;
        const bool everywhere = holdout.reach == MatteReach();
        return std::all_of(jobs.begin(), jobs.end(), [&](const Job& job) {
            if (job.in_front() || job.region != holdout.region) return true;
            return everywhere && holdout.keys.size() == 1 && job.keys.size() == 1 &&
                   holdout.confirmed.empty() && job.confirmed.empty() &&
                   holdout.keys.front() <= job.keys.front();
        });
    });
}

// The walks to be made one after another: of all together, or of holdouts first.
std::vector<std::vector<Job>> walks_of(std::vector<Job> jobs) {
    std::vector<std::vector<Job>> walks;
    if (jobs.empty()) return walks;
    if (known_in_time(jobs)) {
        walks.push_back(std::move(jobs));
        return walks;
    }
    const auto behind = std::stable_partition(jobs.begin(), jobs.end(),
                                              [](const Job& job) { return job.in_front(); });
    walks.emplace_back(std::make_move_iterator(jobs.begin()), std::make_move_iterator(behind));
    walks.emplace_back(std::make_move_iterator(behind), std::make_move_iterator(jobs.end()));
    return walks;
}

constexpr auto kAll = [](const Job&) { return true; };

// Whether the motion is lost everywhere, too: the picture of a fast pan is found again in places.
bool is_cut(const SweepFrame& at) {
    constexpr double kFound = 0.35;
    if (!at.cut || !at.prev_from_cur) return false;
    const Matte& valid = at.prev_from_cur->get().valid;
    std::int64_t found = 0;
    for (int y = 0; y < valid.height(); ++y)
        found += std::count_if(valid.row(y), valid.row(y) + valid.width(),
                               [](std::uint8_t v) { return v != 0; });
    return static_cast<double>(found) < kFound * valid.width() * valid.height();
}

std::shared_ptr<const SceneFrame> scene_of(const SweepFrame& at) {
    static const FlowField kNone;
    return std::make_shared<const SceneFrame>(
        scene_frame(at.views->followed(), at.prev_from_cur ? at.prev_from_cur->get() : kNone));
}

// Begins a job's walk with a painted matte of the plate's size.
void begin(Job& job, const MatteStop& at, const Matte& painted, const Matte& front) {
    Matte smaller;
    job.walker.emplace(at.walked, at.reduce(painted, smaller), job.options, front);
    job.scene = SceneWatch();
    static_cast<void>(job.scene.still_shows(at.scene));
    job.options.soft_edges |= job.walker->has_soft_edges();
}

// Where the scene has become another one without a clear cut the walk goes on, for what it finds
// may be right, but nothing speaks for it.
MatteEstimate advance(Job& job, const MatteStop& at, const Matte& front) {
    MatteEstimate estimate = job.walker->advance(at.walked, at.prev_from_cur->get(), front);
    if (!job.scene.still_shows(at.scene)) estimate.confidence = 0;
    return estimate;
}

// Advances a job's walker to this frame, which is one of `within`, on the way that begins at
// `start`. The estimate is of matte_size(), as `front` is; on a keyframe it is the painted matte
// itself.
Expected<MatteEstimate> walk(const PassContext& context, Job& job, FrameSpan within, int start,
                             const MatteStop& at, const Matte& front) {
    if (job.is_key(at.frame)) {
        WEFT_TRY(key, painted_matte(context.source, job, at.frame));
        learn_key(job, at, key);
        if (length(within) > 1) begin(job, at, key, front);
        return MatteEstimate{std::move(key), 1.0f};
    }
    if (at.cut) job.walker.reset();
    if (!job.is_confirmed(at.frame)) {
        return job.walker ? advance(job, at, front) : not_there(at.walked.size());
    }
    WEFT_TRY(part, context.source.confirmed_part(job.region, job.layer, at.frame));
    if (at.frame == start || !job.walker)
        begin(job, at, part.matte, front);
    else
        (void)advance(job, at, front);
    // What is confirmed belongs to this scene.
    job.scene = SceneWatch();
    static_cast<void>(job.scene.still_shows(at.scene));
    Matte matte, area;
    return job.walker->confirm({at.reduce(part.matte, matte), at.reduce(part.area, area)});
}

// What the walk has just found of earlier frames; it ends at frame `end`.
void complete_earlier(Job& job, int frame, int step, int end) {
    if (job.walker) job.pending.complete(frame, step, job.walker->take_late());
    if (frame == end) job.walker.reset();
}

// What is behind a holdout needs its mattes at once, so they are not completed later.
Status put_pending(AnalysisStore& store, Job& job, int frame, int end) {
    for (PendingMatte& done : job.pending.take(frame, frame == end || job.in_front()))
        WEFT_CHECK_OK(put_estimate(store, job, done.frame, done.kind, std::move(done.estimate)));
    return {};
}

Status visit_forward(const PassContext& context, AnalysisStore& store, std::vector<Job>& jobs,
                     const MatteStop& at) {
    for (Job& job : jobs) {
        const FrameSpan within = job.forward();
        if (!holds(within, at.frame)) continue;
        WEFT_TRY(front, in_front_of(context, store, job, at.frame));
        Matte smaller;
        const Matte& walked_front = at.reduce(front, smaller);
        WEFT_TRY(estimate, walk(context, job, within, within.first, at, walked_front));
        complete_earlier(job, at.frame, 1, within.last);
        if (job.reach.covers(at.frame, job.keys)) {
            const bool open = !job.is_key(at.frame) && !job.is_confirmed(at.frame);
            // What is merged on the way back stays as it was found.
            const bool merged = job.merged(at.frame);
            if (!merged) {
                WEFT_TRY(found, of_plate(context, std::move(estimate), job, at, front));
                estimate = std::move(found);
            }
            job.pending.add({at.frame, merged ? AnalysisKind::kMatteForward : AnalysisKind::kMatte,
                             std::move(estimate), open});
        }
        WEFT_CHECK_OK(put_pending(store, job, at.frame, within.last));
    }
    return {};
}

Status visit_backward(const PassContext& context, AnalysisStore& store, std::vector<Job>& jobs,
                      const MatteStop& at) {
    for (Job& job : jobs) {
        if (!holds(job.collecting(), at.frame)) continue;
        if (job.is_key(at.frame)) WEFT_CHECK_OK(collect_key(context, job, at));
        const FrameSpan within = job.backward();
        if (!holds(within, at.frame)) continue;
        WEFT_TRY(front, in_front_of(context, store, job, at.frame));
        Matte smaller;
        const Matte& walked_front = at.reduce(front, smaller);
        WEFT_TRY(estimate, walk(context, job, within, within.last, at, walked_front));
        complete_earlier(job, at.frame, -1, within.first);
        if (!job.is_key(at.frame) && job.reach.covers(at.frame, job.keys)) {
            if (job.merged(at.frame)) {
                WEFT_CHECK_OK(collect(store, job, at, std::move(estimate), walked_front));
            } else {
                WEFT_TRY(found, of_plate(context, std::move(estimate), job, at, front));
                job.pending.add({at.frame, AnalysisKind::kMatte, std::move(found),
                                 !job.is_confirmed(at.frame)});
            }
        }
        WEFT_CHECK_OK(put_pending(store, job, at.frame, within.first));
    }
    return {};
}

// A matte is empty beyond the reach of its propagation.
Status fill_the_rest(const PassContext& context, AnalysisStore& store,
                     const std::vector<Job>& jobs) {
    for (const Job& job : jobs) {
        for (int frame = job.own.first; frame <= job.own.last; ++frame) {
            if (job.reach.covers(frame, job.keys)) continue;
            WEFT_CHECK_OK(put_estimate(store, job, frame, AnalysisKind::kMatte,
                                       {Matte(context.source.size()), 1.0f}));
        }
    }
    return {};
}

Status propagate(const PassContext& context, AnalysisStore& store, std::vector<Job> jobs) {
    using Visit =
        Status (*)(const PassContext&, AnalysisStore&, std::vector<Job>&, const MatteStop&);
    const auto walk_mattes = [&](const SweepOptions& options, Visit visit) {
        return sweep(context, options, [&](const SweepFrame& seen) -> Status {
            return stop_at(seen, [&](const MatteStop& there) {
                MatteStop at = there;
                at.cut = is_cut(seen);
                at.scene = scene_of(seen);
                return visit(context, store, jobs, at);
            });
        });
    };
    const FrameSpan there = visited(jobs, &Job::forward), back = visited(jobs, &Job::collecting);
    if (length(there) > 0)
        WEFT_CHECK_OK(walk_mattes({there.first, there.last, true}, visit_forward));
    if (length(back) > 0) WEFT_CHECK_OK(walk_mattes({back.last, back.first, true}, visit_backward));
    WEFT_CHECK_OK(join_walks(context, store, jobs));
    return fill_the_rest(context, store, jobs);
}

Status propagate_all(const PassContext& context, AnalysisStore& store, std::vector<Job> jobs) {
    for (std::vector<Job>& walk : walks_of(std::move(jobs)))
        WEFT_CHECK_OK(propagate(context, store, std::move(walk)));
    return {};
}

}  // namespace

int count_matte_steps(const ShotPlan& plan, const AnalysisStore& store) {
    int steps = 0;
    for (const std::vector<Job>& jobs : walks_of(jobs_of(plan, store, kAll)))
        for (const auto of : {&Job::forward, &Job::collecting, &Job::merging})
            steps += length(visited(jobs, of));
    return steps;
}

Status propagate_mattes(const PassContext& context, AnalysisStore& store) {
    return propagate_all(context, store, jobs_of(context.plan, store, kAll));
}

Status propagate_mattes_at(const PassContext& context, AnalysisStore& store, int frame) {
    const auto after = [&](const Job& job) { return holds(job.own, frame); };
    const auto before = [&](const Job& job) {
        return job.own.first < frame && job.keys.back() == frame;
    };
    WEFT_CHECK_OK(propagate_all(context, store, jobs_of(context.plan, store, after)));
    return propagate_all(context, store, jobs_of(context.plan, store, before));
}

}  // namespace weft

#include "engine/pipeline/matte_pass.h"

#include <algorithm>
#include <map>
#include <optional>

#include "engine/mask/matte_propagation.h"
#include "engine/motion/follow_size.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/region_zones.h"

namespace weft {
namespace {

// A painted matte to propagate, a region's, a holdout's or a zone's, with its walker on the present
// sweep.
struct Job {
    int region = 0, layer = 0;  // as in AnalysisKey
    std::vector<int> keys;
    MatteReach reach;
    FrameSpan span;
    MatteOptions options;
    std::optional<MatteWalker> walker;

    [[nodiscard]] bool is_key(int frame) const {
        return std::binary_search(keys.begin(), keys.end(), frame);
    }
    [[nodiscard]] bool between_keys(int frame) const {
        return frame > keys.front() && frame < keys.back();
    }
    // Between two keys, propagation in both directions gives two estimates to merge.
    [[nodiscard]] bool merged(int frame) const {
        return reach.direction == PropagationDirection::kBoth && between_keys(frame) &&
               !is_key(frame);
    }
    // The frames that the walk visits in each direction.
    [[nodiscard]] FrameSpan forward() const {
        return {keys.front(), reach.forward()
                                  ? std::max(keys.back(), std::min(span.last, reach.last))
                                  : keys.back()};
    }
    [[nodiscard]] FrameSpan backward() const {
        return {reach.backward() ? std::min(keys.front(), std::max(span.first, reach.first))
                                 : keys.front(),
                keys.back()};
    }
};

std::vector<Job> jobs_of(const ShotPlan& plan, const AnalysisStore& store) {
    std::vector<Job> jobs;
    const auto add = [&](Job job) {
        bool complete = true;
        for (int f = job.span.first; f <= job.span.last && complete; ++f)
            complete = store.has({job.region, f, AnalysisKind::kMatte, job.layer});
        if (!complete) jobs.push_back(std::move(job));
    };
    for (std::size_t k = 0; k < plan.regions.size(); ++k) {
        const RegionPlan& region = plan.regions[k];
        const FrameSpan span = analysed_span(plan, region);
        const int index = static_cast<int>(k);
        if (region.propagated())
            add({index,
                 0,
                 region.matte_keys,
                 region.matte_reach,
                 span,
                 {region.matte_steadiness, false},
                 {}});
        const auto add_painted = [&](int layer, const PaintedMatte& painted) {
            add({index, layer, painted.keys, painted.reach, span, {painted.steadiness, false}, {}});
        };
        int layer = 0;
        for (const PaintedMatte& holdout : region.painted_holdouts)
            add_painted(++layer, holdout);
        for (int zone = 0; zone < static_cast<int>(region.zones.size()); ++zone)
            if (const ZonePlan& planned = region.zones[static_cast<std::size_t>(zone)];
                planned.propagated())
                add_painted(zone_layer(zone), planned.painted);
    }
    return jobs;
}

// The frames that the walks of all jobs visit.
FrameSpan walked(const std::vector<Job>& jobs, FrameSpan (Job::*of)() const) {
    FrameSpan all = (jobs[0].*of)();
    for (const Job& job : jobs) {
        const FrameSpan own = (job.*of)();
        all.first = std::min(all.first, own.first);
        all.last = std::max(all.last, own.last);
    }
    return all;
}

Expected<Matte> key_of(const ShotSource& source, const Job& job, int frame) {
    if (is_zone_layer(job.layer))
        return source.zone_key(job.region, zone_of_layer(job.layer), frame);
    return job.layer == 0 ? source.matte_key(job.region, frame)
                          : source.holdout_key(job.region, job.layer - 1, frame);
}

// Advances a job's walker to this frame. On a keyframe the estimate is the painted matte itself.
Expected<std::optional<MatteEstimate>> walk(const PassContext& context, Job& job, FrameSpan within,
                                            const SweepFrame& at) {
    if (job.is_key(at.frame)) {
        auto key = key_of(context.source, job, at.frame);
        if (!key) return tl::unexpected<Error>(std::move(key).error());
        job.walker.emplace(at.views->display, *key, job.options);
        job.options.soft_edges |= job.walker->has_soft_edges();
        return std::optional<MatteEstimate>(MatteEstimate{std::move(*key), 1.0f});
    }
    if (!job.walker || at.frame < within.first || at.frame > within.last || !at.prev_from_cur) {
        return std::optional<MatteEstimate>();
    }
    return std::optional<MatteEstimate>(job.walker->advance(at.views->display, *at.prev_from_cur));
}

Status put(AnalysisStore& store, const Job& job, int frame, AnalysisKind kind,
           MatteEstimate estimate) {
    return store.put({job.region, frame, kind, job.layer},
                     encode(StoredMatte{std::move(estimate.matte), estimate.confidence}));
}

Status visit_forward(const PassContext& context, AnalysisStore& store, std::vector<Job>& jobs,
                     const SweepFrame& at) {
    for (Job& job : jobs) {
        const bool walks = job.reach.forward() || job.is_key(at.frame);
        if (!walks) continue;
        WEFT_TRY(estimate, walk(context, job, job.forward(), at));
        if (!estimate || !job.reach.covers(at.frame, job.keys)) continue;
        const auto kind = job.merged(at.frame) ? AnalysisKind::kMatteForward : AnalysisKind::kMatte;
        WEFT_CHECK_OK(put(store, job, at.frame, kind, std::move(*estimate)));
    }
    return {};
}

Status visit_backward(const PassContext& context, AnalysisStore& store, std::vector<Job>& jobs,
                      const SweepFrame& at) {
    for (Job& job : jobs) {
        if (!job.reach.backward()) continue;
        WEFT_TRY(estimate, walk(context, job, job.backward(), at));
        if (!estimate || job.is_key(at.frame) || !job.reach.covers(at.frame, job.keys)) continue;
        if (!job.merged(at.frame)) {
            if (at.frame < job.keys.back()) {
                WEFT_CHECK_OK(
                    put(store, job, at.frame, AnalysisKind::kMatte, std::move(*estimate)));
            }
            continue;
        }
        WEFT_TRY(bytes, store.get({job.region, at.frame, AnalysisKind::kMatteForward, job.layer}));
        WEFT_TRY(forward, decode_matte(bytes));
        const auto after = std::lower_bound(job.keys.begin(), job.keys.end(), at.frame);
        const float position =
            static_cast<float>(at.frame - *(after - 1)) / static_cast<float>(*after - *(after - 1));
        WEFT_CHECK_OK(put(store, job, at.frame, AnalysisKind::kMatte,
                          merge_estimates({std::move(forward.matte), forward.confidence}, *estimate,
                                          position, at.views->display, job.options)));
    }
    return {};
}

// A matte is empty beyond the reach of its propagation.
Status fill_the_rest(const PassContext& context, AnalysisStore& store,
                     const std::vector<Job>& jobs) {
    for (const Job& job : jobs) {
        for (int frame = job.span.first; frame <= job.span.last; ++frame) {
            if (job.reach.covers(frame, job.keys)) continue;
            WEFT_CHECK_OK(
                put(store, job, frame, AnalysisKind::kMatte, {Matte(context.source.size()), 1.0f}));
        }
    }
    return {};
}

}  // namespace

int count_matte_steps(const ShotPlan& plan, const AnalysisStore& store) {
    const std::vector<Job> jobs = jobs_of(plan, store);
    if (jobs.empty()) return 0;
    const FrameSpan there = walked(jobs, &Job::forward), back = walked(jobs, &Job::backward);
    return there.last - there.first + 1 + back.last - back.first + 1;
}

Status propagate_mattes(const PassContext& context, AnalysisStore& store) {
    std::vector<Job> jobs = jobs_of(context.plan, store);
    if (jobs.empty()) return {};
    const FrameSpan there = walked(jobs, &Job::forward), back = walked(jobs, &Job::backward);
    using Visit =
        Status (*)(const PassContext&, AnalysisStore&, std::vector<Job>&, const SweepFrame&);
    const auto walk_mattes = [&](const SweepOptions& options, Visit visit) {
        return sweep(context, options, [&](SweepFrame at) -> Status {
            // Mattes are of the plate's size.
            const Size plate = at.views->display.size();
            if (!at.prev_from_cur || at.prev_from_cur->size() == plate)
                return visit(context, store, jobs, at);
            const FlowField motion = resized(*at.prev_from_cur, plate);
            at.prev_from_cur = &motion;
            return visit(context, store, jobs, at);
        });
    };
    WEFT_CHECK_OK(walk_mattes({there.first, there.last, true}, visit_forward));
    for (Job& job : jobs)
        job.walker.reset();
    WEFT_CHECK_OK(walk_mattes({back.last, back.first, true}, visit_backward));
    return fill_the_rest(context, store, jobs);
}

}  // namespace weft

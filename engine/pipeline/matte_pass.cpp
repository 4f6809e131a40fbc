#include "engine/pipeline/matte_pass.h"

#include <algorithm>
#include <map>
#include <optional>

#include "engine/mask/matte_propagation.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

// A region to propagate, with its walker on the present sweep.
struct Job {
    int region = 0;
    std::vector<int> keys;
    FrameSpan span;
    MatteOptions options;
    std::optional<MatteWalker> walker;

    [[nodiscard]] bool is_key(int frame) const {
        return std::binary_search(keys.begin(), keys.end(), frame);
    }
    [[nodiscard]] bool between_keys(int frame) const {
        return frame > keys.front() && frame < keys.back();
    }
};

std::vector<Job> jobs_of(const ShotPlan& plan, const AnalysisStore& store) {
    std::vector<Job> jobs;
    for (std::size_t k = 0; k < plan.regions.size(); ++k) {
        const RegionPlan& region = plan.regions[k];
        if (!region.propagated()) continue;
        Job job{static_cast<int>(k),
                region.matte_keys,
                analysed_span(plan, region),
                {region.matte_steadiness, false},
                {}};
        bool complete = true;
        for (int f = job.span.first; f <= job.span.last && complete; ++f) {
            complete = store.has({job.region, f, AnalysisKind::kMatte});
        }
        if (!complete) jobs.push_back(std::move(job));
    }
    return jobs;
}

// Over all jobs: from the first key to the end of the span, and from the last key to its begin.
FrameSpan forward_span(const std::vector<Job>& jobs) {
    FrameSpan all{jobs[0].keys.front(), jobs[0].span.last};
    for (const Job& job : jobs) {
        all.first = std::min(all.first, job.keys.front());
        all.last = std::max(all.last, job.span.last);
    }
    return all;
}

FrameSpan backward_span(const std::vector<Job>& jobs) {
    FrameSpan all{jobs[0].span.first, jobs[0].keys.back()};
    for (const Job& job : jobs) {
        all.first = std::min(all.first, job.span.first);
        all.last = std::max(all.last, job.keys.back());
    }
    return all;
}

// Moves a job's walker to this frame; the estimate is the painted matte itself on a keyframe.
Expected<std::optional<MatteEstimate>> walk(const PassContext& context, Job& job,
                                            const SweepFrame& at) {
    if (job.is_key(at.frame)) {
        WEFT_TRY(key, context.source.matte_key(job.region, at.frame));
        job.walker.emplace(at.views->display, key, job.options);
        job.options.soft_edges |= job.walker->has_soft_edges();
        return std::optional<MatteEstimate>(MatteEstimate{std::move(key), 1.0f});
    }
    if (!job.walker || at.frame < job.span.first || at.frame > job.span.last || !at.prev_from_cur) {
        return std::optional<MatteEstimate>();
    }
    return std::optional<MatteEstimate>(job.walker->advance(at.views->display, *at.prev_from_cur));
}

Status put(AnalysisStore& store, int region, int frame, AnalysisKind kind, MatteEstimate estimate) {
    return store.put({region, frame, kind},
                     encode(StoredMatte{std::move(estimate.matte), estimate.confidence}));
}

Status visit_forward(const PassContext& context, AnalysisStore& store, std::vector<Job>& jobs,
                     const SweepFrame& at) {
    for (Job& job : jobs) {
        WEFT_TRY(estimate, walk(context, job, at));
        if (!estimate) continue;
        const auto kind = job.between_keys(at.frame) && !job.is_key(at.frame)
                              ? AnalysisKind::kMatteForward
                              : AnalysisKind::kMatte;
        WEFT_CHECK_OK(put(store, job.region, at.frame, kind, std::move(*estimate)));
    }
    return {};
}

Status visit_backward(const PassContext& context, AnalysisStore& store, std::vector<Job>& jobs,
                      const SweepFrame& at) {
    for (Job& job : jobs) {
        WEFT_TRY(estimate, walk(context, job, at));
        if (!estimate || job.is_key(at.frame)) continue;
        if (!job.between_keys(at.frame)) {
            if (at.frame < job.keys.front()) {
                WEFT_CHECK_OK(
                    put(store, job.region, at.frame, AnalysisKind::kMatte, std::move(*estimate)));
            }
            continue;
        }
        WEFT_TRY(bytes, store.get({job.region, at.frame, AnalysisKind::kMatteForward}));
        WEFT_TRY(forward, decode_matte(bytes));
        const auto after = std::lower_bound(job.keys.begin(), job.keys.end(), at.frame);
        const float position =
            static_cast<float>(at.frame - *(after - 1)) / static_cast<float>(*after - *(after - 1));
        WEFT_CHECK_OK(put(store, job.region, at.frame, AnalysisKind::kMatte,
                          merge_estimates({std::move(forward.matte), forward.confidence}, *estimate,
                                          position, at.views->display, job.options)));
    }
    return {};
}

}  // namespace

int count_matte_steps(const ShotPlan& plan, const AnalysisStore& store) {
    const std::vector<Job> jobs = jobs_of(plan, store);
    if (jobs.empty()) return 0;
    const FrameSpan there = forward_span(jobs), back = backward_span(jobs);
    return there.last - there.first + 1 + back.last - back.first + 1;
}

Status propagate_mattes(const PassContext& context, AnalysisStore& store) {
    std::vector<Job> jobs = jobs_of(context.plan, store);
    if (jobs.empty()) return {};
    const FrameSpan there = forward_span(jobs), back = backward_span(jobs);
    WEFT_CHECK_OK(sweep(context, {there.first, there.last, true}, [&](const SweepFrame& at) {
        return visit_forward(context, store, jobs, at);
    }));
    for (Job& job : jobs)
        job.walker.reset();
    return sweep(context, {back.last, back.first, true},
                 [&](const SweepFrame& at) { return visit_backward(context, store, jobs, at); });
}

}  // namespace weft

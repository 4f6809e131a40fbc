#include "engine/pipeline/matte_join.h"

#include <optional>
#include <utility>

namespace weft {
namespace {

using Job = MatteStretch;

MergePlace place_of(const Job& job, int frame) {
    return {frame, job.key_before(), job.key_after()};
}

// Two walks that have both lost their scene may agree by chance.
MatteEstimate merged(const MatteEstimate& forward, const MatteEstimate& backward, const Job& job,
                     const MatteStop& at, const Matte& front) {
    const ImageF1 inside = job.joint.inside(at.frame, forward.matte, backward.matte);
    MatteEstimate out = merge_estimates(forward, backward, place_of(job, at.frame), at.walked,
                                        job.options, front, inside);
    if (forward.confidence == 0 && backward.confidence == 0) out.confidence = 0;
    return out;
}

Status join_at(const PassContext& context, AnalysisStore& store, Job& job, const MatteStop& at) {
    WEFT_TRY(forward, get_estimate(store, job, at.frame, AnalysisKind::kMatteForward));
    WEFT_TRY(backward, get_estimate(store, job, at.frame, AnalysisKind::kMatteBackward));
    WEFT_TRY(front, in_front_of(context, store, job, at.frame));
    Matte smaller;
    MatteEstimate estimate = is_not_there(backward) ? std::move(forward)
                             : is_not_there(forward)
                                 ? std::move(backward)
                                 : merged(forward, backward, job, at, at.reduce(front, smaller));
    WEFT_TRY(found, of_plate(context, std::move(estimate), job, at, front));
    return put_estimate(store, job, at.frame, AnalysisKind::kMatte, std::move(found));
}

void add_known(Job& job, const MatteStop& at, const Matte& matte) {
    job.joint.add({at.frame, at.walked, matte, matte, {}, {}, at.motion_if_no_cut()});
}

}  // namespace

void learn_key(MatteStretch& job, const MatteStop& at, const Matte& painted) {
    Matte smaller;
    if (length(job.merging()) > 0) job.joint.remember(at.walked, at.reduce(painted, smaller));
}

Status collect_key(const PassContext& context, MatteStretch& job, const MatteStop& at) {
    if (length(job.merging()) == 0) return {};
    WEFT_TRY(painted, painted_matte(context.source, job, at.frame));
    Matte smaller;
    add_known(job, at, at.reduce(painted, smaller));
    return {};
}

Status collect(AnalysisStore& store, MatteStretch& job, const MatteStop& at, MatteEstimate backward,
               const Matte& front) {
    WEFT_TRY(forward, get_estimate(store, job, at.frame, AnalysisKind::kMatteForward));
    if (is_not_there(backward) || is_not_there(forward)) {
        add_known(job, at, is_not_there(backward) ? forward.matte : backward.matte);
    } else {
        const ImageF1 shares =
            merge_shares(forward, backward, place_of(job, at.frame), at.walked.size());
        job.joint.add({at.frame, at.walked, forward.matte, backward.matte, shares, front,
                       at.motion_if_no_cut()});
    }
    return put_estimate(store, job, at.frame, AnalysisKind::kMatteBackward, std::move(backward));
}

Status join_walks(const PassContext& context, AnalysisStore& store,
                  std::vector<MatteStretch>& jobs) {
    const FrameSpan all = visited(jobs, &Job::merging);
    if (length(all) == 0) return {};
    for (Job& job : jobs)
        job.joint.decide();
    return sweep(context, {all.first, all.last, false}, [&](const SweepFrame& seen) -> Status {
        return stop_at(seen, [&](const MatteStop& at) -> Status {
            for (Job& job : jobs) {
                if (!job.merged(at.frame) || !job.reach.covers(at.frame, job.keys)) continue;
                WEFT_CHECK_OK(join_at(context, store, job, at));
            }
            return {};
        });
    });
}

}  // namespace weft

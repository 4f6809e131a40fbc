#include "engine/pipeline/matte_stop.h"

#include <utility>

#include "engine/mask/plate_edge.h"
#include "engine/motion/follow_size.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_zones.h"

namespace weft {

const Matte& MatteStop::reduce(const Matte& matte, Matte& smaller) const {
    if (matte.empty() || matte.size() == walked.size()) return matte;
    return smaller = reduced(matte, walked.size());
}

Status stop_at(const SweepFrame& at, const std::function<Status(const MatteStop&)>& visit) {
    const ImageU8x3& plate = at.views->display;
    const Size size = matte_size(plate.size());
    const ImageU8x3 smaller = size == plate.size() ? ImageU8x3() : reduced(plate, size);
    const FrameMotion larger([&] { return resized(at.prev_from_cur->get(), size); });
    const bool as_followed = at.views->followed().size() == size;
    const FrameMotion* motion = as_followed ? at.prev_from_cur.get() : &larger;
    return visit(
        {at.frame, plate, smaller.empty() ? plate : smaller, at.prev_from_cur ? motion : nullptr});
}

Expected<Matte> painted_matte(const ShotSource& source, const MatteStretch& job, int frame) {
    if (is_zone_layer(job.layer))
        return source.zone_key(job.region, zone_of_layer(job.layer), frame);
    return job.layer == 0 ? source.matte_key(job.region, frame)
                          : source.holdout_key(job.region, job.layer - 1, frame);
}

Expected<Matte> in_front_of(const PassContext& context, const AnalysisStore& store,
                            const MatteStretch& job, int frame) {
    if (job.in_front()) return Matte();
    return holdout_matte(context.source, context.plan, store, job.region, frame);
}

Expected<MatteEstimate> of_plate(const PassContext& context, MatteEstimate estimate,
                                 const MatteStretch& job, const MatteStop& at, const Matte& front) {
    if (estimate.matte.size() != at.plate.size())
        estimate.matte = at_plate_size(estimate.matte, at.plate, front, job.options);
    if (job.is_confirmed(at.frame)) {
        WEFT_TRY(part, context.source.confirmed_part(job.region, job.layer, at.frame));
        estimate.matte = with_confirmed(std::move(estimate.matte), part);
    }
    return MatteEstimate{std::move(estimate.matte), estimate.confidence};
}

MatteEstimate not_there(Size size) {
    return {Matte(size), 0.0f};
}

bool is_not_there(const MatteEstimate& estimate) {
    return estimate.confidence == 0 && matte_bounds(estimate.matte).empty();
}

Status put_estimate(AnalysisStore& store, const MatteStretch& job, int frame, AnalysisKind kind,
                    MatteEstimate estimate) {
    return store.put({job.region, frame, kind, job.layer},
                     encode(StoredMatte{std::move(estimate.matte), estimate.confidence,
                                        std::move(estimate.since), estimate.since_confidence,
                                        std::move(estimate.followed)}));
}

Expected<MatteEstimate> get_estimate(const AnalysisStore& store, const MatteStretch& job, int frame,
                                     AnalysisKind kind) {
    WEFT_TRY(bytes, store.get({job.region, frame, kind, job.layer}));
    WEFT_TRY(stored, decode_matte(bytes));
    return MatteEstimate{std::move(stored.matte), stored.confidence, std::move(stored.since),
                         stored.since_confidence, std::move(stored.followed)};
}

}  // namespace weft

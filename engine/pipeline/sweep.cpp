#include "engine/pipeline/sweep.h"

#include <chrono>
#include <future>

namespace weft {
namespace {

struct Loaded {
    std::shared_ptr<const ImageF3> plate;
    PlateViews views;
};

Expected<Loaded> load(const PassContext& context, int frame) {
    WEFT_TRY(plate, context.source.plate(frame));
    Loaded loaded{plate, make_views(*plate, *context.plan.display_from_plate)};
    return loaded;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

tl::unexpected<Error> cancelled(const CancelToken& cancel) {
    return cancel.reason() == 130 ? fail(ErrorCode::kInterrupted, "Interrupted.")
                                  : fail(ErrorCode::kTerminated, "Stopped on request.");
}

Status sweep(const PassContext& context, const SweepOptions& options, const SweepVisitor& visit) {
    const int step = options.last >= options.first ? 1 : -1;
    auto next = std::async(std::launch::async, [&] { return load(context, options.first); });
    Loaded previous;
    for (int frame = options.first;; frame += step) {
        const auto start = std::chrono::steady_clock::now();
        WEFT_TRY(current, next.get());
        if (context.cancel.cancelled()) return cancelled(context.cancel);
        if (frame != options.last) {
            next = std::async(std::launch::async,
                              [&context, frame, step] { return load(context, frame + step); });
        }
        FlowField motion;
        if (options.motion && previous.plate) {
            const FlowQuality quality = context.plan.quality;
            motion = estimate_flow(current.views.luma, previous.views.luma, quality);
            FlowField back = estimate_flow(previous.views.luma, current.views.luma, quality);
            check_consistency(motion, back);
        }
        WEFT_CHECK_OK(
            visit({frame, current.plate, &current.views, motion.empty() ? nullptr : &motion}));
        if (context.step) context.step(frame, seconds_since(start));
        previous = std::move(current);
        if (frame == options.last) return {};
    }
}

}  // namespace weft

#include "engine/pipeline/sweep.h"

#include <chrono>
#include <future>
#include <optional>
#include <utility>

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

FlowField motion_between(const ShotPlan& plan, int frame, const PlateViews& current, int previous,
                         const PlateViews& previous_views) {
    if (plan.stages) {
        if (auto kept = plan.stages->motion(frame, previous)) return std::move(*kept);
    }
    FlowField motion = estimate_flow(current.luma, previous_views.luma, plan.quality);
    FlowField back = estimate_flow(previous_views.luma, current.luma, plan.quality);
    check_consistency(motion, back);
    return motion;
}

Status keep_motion(const ShotSource& source, const ShotPlan& plan, const std::vector<int>& frames,
                   FrameSpan span, const CancelToken& cancel, const ProgressFn& progress) {
    if (!plan.stages) return {};
    const PassContext context{source, plan, cancel, {}, nullptr};
    ProgressEvent event{"motion", 0, static_cast<std::int64_t>(frames.size()), 0, 0};
    std::optional<std::pair<int, Loaded>> last;
    for (const int frame : frames) {
        const auto start = std::chrono::steady_clock::now();
        if (cancel.cancelled()) return cancelled(cancel);
        if (frame > span.first) {
            if (!last || last->first != frame - 1) {
                WEFT_TRY(before, load(context, frame - 1));
                last.emplace(frame - 1, std::move(before));
            }
            WEFT_TRY(here, load(context, frame));
            const PlateViews& before = last->second.views;
            if (!plan.stages->motion(frame, frame - 1) || !plan.stages->motion(frame - 1, frame)) {
                // One estimate each way serves both directions of a sweep.
                FlowField down = estimate_flow(here.views.luma, before.luma, plan.quality);
                FlowField up = estimate_flow(before.luma, here.views.luma, plan.quality);
                const FlowField plain_down = down, plain_up = up;
                FlowField other = plain_up;
                check_consistency(down, other);
                other = plain_down;
                check_consistency(up, other);
                plan.stages->keep_motion(frame, frame - 1, down);
                plan.stages->keep_motion(frame - 1, frame, up);
            }
            last.emplace(frame, std::move(here));
        }
        ++event.done;
        event.frame = frame;
        event.seconds = seconds_since(start);
        if (progress) progress(event);
    }
    return {};
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
            motion =
                motion_between(context.plan, frame, current.views, frame - step, previous.views);
        }
        WEFT_CHECK_OK(
            visit({frame, current.plate, &current.views, motion.empty() ? nullptr : &motion}));
        if (context.step) context.step(frame, seconds_since(start));
        previous = std::move(current);
        if (frame == options.last) return {};
    }
}

}  // namespace weft

#include "engine/pipeline/sweep.h"

#include <future>
#include <optional>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"

namespace weft {
namespace {

struct Loaded {
    int frame = 0;
    std::shared_ptr<const ImageF3> plate;
    PlateViews views;
    FlowField motion;  // to the frame before, once it has been estimated
};

Expected<Loaded> load(const PassContext& context, int frame) {
    WEFT_TRY(plate, context.source.plate(frame));
    Loaded loaded{frame, plate, make_views(*plate, *context.plan.display_from_plate), {}};
    return loaded;
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
    FlowPair motion = estimate_flows(current.followed(), previous_views.followed(), plan.quality);
    check_consistency(motion.b_from_a, motion.a_from_b.d);
    return std::move(motion.b_from_a);
}

Status keep_motion(const ShotSource& source, const ShotPlan& plan, const std::vector<int>& frames,
                   FrameSpan span, const CancelToken& cancel, const ProgressFn& progress) {
    if (!plan.stages) return {};
    const PassContext context{source, plan, cancel, {}, nullptr};
    ProgressEvent event{"motion", 0, static_cast<std::int64_t>(frames.size()), 0, 0};
    std::optional<std::pair<int, Loaded>> last;
    for (const int frame : frames) {
        const auto start = Clock::now();
        if (cancel.cancelled()) return cancelled(cancel);
        if (frame > span.first) {
            if (!last || last->first != frame - 1) {
                WEFT_TRY(before, load(context, frame - 1));
                last.emplace(frame - 1, std::move(before));
            }
            WEFT_TRY(here, load(context, frame));
            const PlateViews& before = last->second.views;
            if (!plan.stages->motion(frame, frame - 1) || !plan.stages->motion(frame - 1, frame)) {
                // One estimate in each direction serves sweeps both ways.
                auto [down, up] =
                    estimate_flows(here.views.followed(), before.followed(), plan.quality);
                check_consistency(down, up);
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
    // With one thread, only reading runs beside the visitor.
    const bool ahead = thread_count() > 1;
    const auto motion_from = [&](const Loaded& current, const Loaded& previous) {
        return options.motion ? motion_between(context.plan, current.frame, current.views,
                                               previous.frame, previous.views)
                              : FlowField{};
    };
    const auto load_next = [&](int frame, const Loaded* previous) -> Expected<Loaded> {
        WEFT_TRY(loaded, load(context, frame));
        if (ahead && previous && !context.cancel.cancelled())
            loaded.motion = motion_from(loaded, *previous);
        return loaded;
    };
    Loaded previous, current;
    auto next = std::async(std::launch::async, load_next, options.first, nullptr);
    for (int frame = options.first;; frame += step) {
        const auto start = Clock::now();
        WEFT_TRY(here, next.get());
        current = std::move(here);
        if (context.cancel.cancelled()) return cancelled(context.cancel);
        // `current` must not move until the task has finished.
        if (frame != options.last)
            next = std::async(std::launch::async, load_next, frame + step, &current);
        if (!ahead && previous.plate) current.motion = motion_from(current, previous);
        WEFT_CHECK_OK(visit({frame, current.plate, &current.views,
                             current.motion.empty() ? nullptr : &current.motion}));
        if (context.step) context.step(frame, seconds_since(start));
        if (frame == options.last) return {};
        if (!ahead) previous = std::move(current);
    }
}

}  // namespace weft

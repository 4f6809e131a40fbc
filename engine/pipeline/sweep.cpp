#include "engine/pipeline/sweep.h"

#include <cstdlib>
#include <deque>
#include <future>
#include <memory>
#include <optional>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/core/work_thread.h"
#include "engine/pipeline/shown_frames.h"
#include "engine/pipeline/walk_memory.h"

namespace weft {

tl::unexpected<Error> cancelled(const CancelToken& cancel) {
    return cancel.reason() == 130 ? fail(ErrorCode::kInterrupted, "Interrupted.")
                                  : fail(ErrorCode::kTerminated, "Stopped on request.");
}

namespace {

Expected<SweepFrame> load(const PassContext& context, int frame) {
    WEFT_TRY(plate, context.source.plate(frame));
    auto views =
        std::make_shared<const PlateViews>(make_views(*plate, *context.plan.display_from_plate));
    return SweepFrame{frame, plate, std::move(views), frame, false, nullptr};
}

// Several frames on their way to the visitor: one is being read and its motion estimated, others
// are being prepared. With one thread in all, only reading runs beside the visitor.
class Conveyor {
  public:
    Conveyor(const PassContext& context, const SweepOptions& options, const SweepVisitor& prepare)
        : context_(context),
          options_(options),
          prepare_(prepare),
          step_(options.last >= options.first ? 1 : -1),
          count_(std::abs(options.last - options.first) + 1),
          ahead_(thread_count() > 1) {
        if (ahead_) {
            for (int k = 0; k < options_.ahead; ++k) {
                read(k);
                prepare_ahead(k);
            }
            read(options_.ahead);
        } else {
            read(0);
            read(1);
        }
    }

    [[nodiscard]] int count() const { return count_; }

    // The next frame, prepared.
    Expected<SweepFrame> next() {
        const int k = next_++;
        if (!ahead_) {
            WEFT_TRY(frame, reading_[0].get());
            reading_.pop_front();
            read(k + 2);
            WEFT_CHECK_OK(add_motion(frame, k));
            return prepared(std::move(frame));
        }
        auto frame = preparing_.front().get();
        preparing_.pop_front();
        prepare_ahead(k + options_.ahead);
        read(k + options_.ahead + 1);
        return frame;
    }

  private:
    using Coming = std::future<Expected<SweepFrame>>;

    // Of the frame after the one of the last call, number k.
    Status add_motion(SweepFrame& frame, int k) {
        const auto peek = [&](int ahead) -> Expected<ShownFrames::Seen> {
            if (k + ahead >= count_ || context_.cancel.cancelled()) return ShownFrames::Seen{};
            WEFT_TRY(later, load(context_, options_.first + step_ * (k + ahead)));
            return ShownFrames::Seen{later.frame, std::move(later.views), false};
        };
        WEFT_TRY(seen, shown_.next({frame.frame, frame.views, false}, peek));
        frame.seen = seen.frame;
        frame.cut = seen.cut;
        frame.views = std::move(seen.views);
        if (options_.motion && before_.views && !context_.cancel.cancelled()) {
            FrameMotion::Estimate estimate = [&plan = context_.plan, number = frame.frame,
                                              views = frame.views, before_number = before_.frame,
                                              before_views = before_.views] {
                if (views == before_views) return FlowField(views->followed().size());
                return motion_between(plan, number, *views, before_number, *before_views);
            };
            frame.prev_from_cur =
                context_.motions
                    ? context_.motions->between(frame.seen, before_.seen, std::move(estimate))
                    : std::make_shared<const FrameMotion>(std::move(estimate));
            const bool expected =
                options_.known && options_.known->expects(frame.frame, before_.frame);
            if (!expected) static_cast<void>(frame.prev_from_cur->get());
        }
        before_ = frame;
        return {};
    }

    Expected<SweepFrame> prepared(Expected<SweepFrame> frame) {
        if (frame && prepare_ && !context_.cancel.cancelled()) WEFT_CHECK_OK(prepare_(*frame));
        return frame;
    }

    void read(int k) {
        if (k >= count_) return;
        reading_.push_back(reader_.run([this, k]() -> Expected<SweepFrame> {
            if (context_.cancel.cancelled()) return cancelled(context_.cancel);
            auto frame = load(context_, options_.first + step_ * k);
            if (frame && ahead_) WEFT_CHECK_OK(add_motion(*frame, k));
            return frame;
        }));
    }

    // Frame number k, which is the only one that has been read or is being read.
    void prepare_ahead(int k) {
        if (k >= count_) return;
        auto coming = std::make_shared<Coming>(std::move(reading_.front()));
        reading_.pop_front();
        preparing_.push_back(preparer_.run([this, coming] { return prepared(coming->get()); }));
    }

    const PassContext& context_;
    const SweepOptions& options_;
    const SweepVisitor& prepare_;
    const int step_, count_;
    const bool ahead_;
    int next_ = 0;
    SweepFrame before_;
    ShownFrames shown_;
    std::deque<Coming> reading_, preparing_;
    WorkThread reader_, preparer_;  // use the members above until they are destroyed
};

}  // namespace

FlowField motion_between(const ShotPlan& plan, int frame, const PlateViews& current, int previous,
                         const PlateViews& previous_views) {
    if (plan.stages) {
        if (auto kept = plan.stages->motion(frame, previous)) return std::move(*kept);
    }
    FlowPair motion =
        estimate_flows(current.followed(), previous_views.followed(), plan.motion_quality);
    check_consistency(motion.b_from_a, motion.a_from_b.d);
    return std::move(motion.b_from_a);
}

Status keep_motion(const ShotSource& source, const ShotPlan& plan, const std::vector<int>& frames,
                   FrameSpan span, const CancelToken& cancel, const ProgressFn& progress) {
    if (!plan.stages) return {};
    const PassContext context{source, plan, cancel, {}, nullptr};
    ProgressEvent event{WorkStage::kMotion, 0, static_cast<std::int64_t>(frames.size()), 0, 0};
    std::optional<std::pair<int, SweepFrame>> last;
    for (const int frame : frames) {
        const auto start = Clock::now();
        if (cancel.cancelled()) return cancelled(cancel);
        if (frame > span.first) {
            if (!last || last->first != frame - 1) {
                WEFT_TRY(before, load(context, frame - 1));
                last.emplace(frame - 1, std::move(before));
            }
            WEFT_TRY(here, load(context, frame));
            const PlateViews& before = *last->second.views;
            const bool known =
                plan.stages->motion(frame, frame - 1) && plan.stages->motion(frame - 1, frame);
            // Across a frame that shows nothing, the sweep knows which to compare.
            if (!known && are_neighbours(*here.views, before)) {
                // One estimate in each direction serves sweeps both ways.
                auto [down, up] =
                    estimate_flows(here.views->followed(), before.followed(), plan.motion_quality);
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

Status sweep(const PassContext& context, const SweepOptions& options, const SweepVisitor& visit,
             const SweepVisitor& prepare) {
    Conveyor conveyor(context, options, prepare);
    for (int k = 0; k < conveyor.count(); ++k) {
        const auto start = Clock::now();
        WEFT_TRY(at, conveyor.next());
        if (context.cancel.cancelled()) return cancelled(context.cancel);
        WEFT_CHECK_OK(visit(at));
        if (context.step) context.step(at.frame, seconds_since(start));
    }
    return {};
}

}  // namespace weft

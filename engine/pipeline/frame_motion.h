#pragma once
// The motion between two neighbouring frames, estimated when it is first asked for.

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "engine/core/fields.h"

namespace weft {

/// Thread-safe.
class FrameMotion {
  public:
    using Estimate = std::function<FlowField()>;
    explicit FrameMotion(Estimate estimate) : estimate_(std::move(estimate)) {}

    [[nodiscard]] const FlowField& get() const {
        std::call_once(estimated_, [&] { flow_ = std::exchange(estimate_, {})(); });
        return flow_;
    }

  private:
    mutable std::once_flag estimated_;
    mutable Estimate estimate_;
    mutable FlowField flow_;
};

/// The latest motions that sweeps have asked for, so that sweeps side by side estimate each once.
/// Thread-safe.
class RecentMotions {
  public:
    /// The motion from frame `cur` to `prev`; `estimate` makes it if it is not kept.
    [[nodiscard]] std::shared_ptr<const FrameMotion> between(int cur, int prev,
                                                             FrameMotion::Estimate estimate) {
        const std::lock_guard lock(mutex_);
        for (const Kept& kept : kept_)
            if (kept.cur == cur && kept.prev == prev) return kept.motion;
        if (kept_.size() == kMost) kept_.pop_front();
        kept_.push_back({cur, prev, std::make_shared<const FrameMotion>(std::move(estimate))});
        return kept_.back().motion;
    }

  private:
    static constexpr std::size_t kMost = 14;  // frames that the sweeps are apart and read ahead
    struct Kept {
        int cur, prev;
        std::shared_ptr<const FrameMotion> motion;
    };
    std::mutex mutex_;
    std::deque<Kept> kept_;
};

}  // namespace weft

#pragma once
// The motion between two neighbouring frames, estimated when it is first asked for.

#include <functional>
#include <mutex>
#include <utility>

#include "engine/core/fields.h"

namespace weft {

/// Thread-safe.
class FrameMotion {
  public:
    explicit FrameMotion(std::function<FlowField()> estimate) : estimate_(std::move(estimate)) {}

    [[nodiscard]] const FlowField& get() const {
        std::call_once(estimated_, [&] { flow_ = std::exchange(estimate_, {})(); });
        return flow_;
    }

  private:
    mutable std::once_flag estimated_;
    mutable std::function<FlowField()> estimate_;
    mutable FlowField flow_;
};

}  // namespace weft

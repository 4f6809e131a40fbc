#pragma once
// Work that follows each step of a sequence and need not be waited for before the next step.

#include <functional>
#include <future>
#include <optional>

#include "engine/core/error.h"
#include "engine/core/work_thread.h"

namespace weft {

/// Runs pieces of work one after another beside the thread that hands them in, at most one behind
/// it. With one thread in all (set_thread_count()) each runs at once. For one thread; its
/// destructor waits.
class FollowUp {
  public:
    /// Waits for the piece before and returns its error, or starts this one.
    [[nodiscard]] Status run(std::function<Status()> work);
    /// Waits for the last piece and returns its error.
    [[nodiscard]] Status finish();

  private:
    std::future<Status> running_;
    std::optional<WorkThread> thread_;  // from the first piece on
};

}  // namespace weft

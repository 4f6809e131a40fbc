#pragma once
#include <atomic>
#include <memory>

namespace weft {

/// Asks running work to stop. Copies share one flag; cancel() may be called from any thread and,
/// being one atomic store, from a signal handler. Cancelled work returns an Error with the code
/// kTerminated or kInterrupted: a result of its own, not a failure.
class CancelToken {
  public:
    CancelToken() : flag_(std::make_shared<std::atomic<int>>(0)) {}
    /// `exit` is the exit code to end with: 130 (interrupted) or 143 (terminated).
    void cancel(int exit = 143) const { flag_->store(exit, std::memory_order_relaxed); }
    [[nodiscard]] bool cancelled() const { return flag_->load(std::memory_order_relaxed) != 0; }
    [[nodiscard]] int reason() const { return flag_->load(std::memory_order_relaxed); }

  private:
    std::shared_ptr<std::atomic<int>> flag_;
};

}  // namespace weft

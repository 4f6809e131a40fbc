#pragma once
// A project that is being collected: what its thread and the window share.

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "engine/core/cancel.h"
#include "engine/core/progress.h"

namespace weft {

/// Copies share their counters. note() is for the copying thread, the rest for any.
class CollectRun {
  public:
    explicit CollectRun(std::string target)
        : folder(std::move(target)), counts_(std::make_shared<Counts>()) {}

    std::string folder;
    CancelToken cancel;

    void note(const ProgressEvent& event) const {
        counts_->total.store(event.total, std::memory_order_relaxed);
        counts_->done.store(event.done, std::memory_order_relaxed);
    }
    [[nodiscard]] std::int64_t done() const {
        return counts_->done.load(std::memory_order_relaxed);
    }
    [[nodiscard]] std::int64_t total() const {
        return counts_->total.load(std::memory_order_relaxed);
    }

  private:
    struct Counts {
        std::atomic<std::int64_t> done{0}, total{0};
    };
    std::shared_ptr<Counts> counts_;
};

}  // namespace weft

#pragma once
#include <chrono>
#include <future>
#include <utility>
#include <vector>

#include "app/base/background.h"

namespace weft {

/// Ends things whose destruction may block, each in a thread of its own. For one thread.
class Shutdowns {
  public:
    /// Destroys it in the background: a worker that may be decoding a large frame, the future of
    /// work that nobody waits for any more.
    template <class T>
    void end(T thing) {
        ends_.push_back(in_background(
            [thing = std::move(thing)]() mutable { const T ended = std::move(thing); }));
    }
    /// Forgets those that have ended.
    void clear_ended() {
        std::erase_if(ends_, [](const std::future<void>& one) {
            return one.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
        });
    }

  private:
    std::vector<std::future<void>> ends_;
};

}  // namespace weft

#pragma once
#include <functional>
#include <future>
#include <utility>
#include <vector>

#include "app/base/background.h"

namespace weft {

/// Background work, each piece of which ends with a function on the owner's thread. All members are
/// for one thread.
class BackgroundTasks {
  public:
    using Finish = std::function<void()>;

    /// Starts `work` in a new thread at a lower priority; it returns a Finish.
    template <class F>
    void start(F&& work) {
        tasks_.push_back(in_background(std::forward<F>(work)));
    }
    /// Runs the functions of the tasks that are done, in the order in which they were started. With
    /// `wait`, waits for all tasks, including those that these functions start.
    void finish(bool wait);
    [[nodiscard]] bool empty() const { return tasks_.empty(); }

  private:
    std::vector<std::future<Finish>> tasks_;
};

}  // namespace weft

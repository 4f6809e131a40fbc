#pragma once
// One thread that works through tasks in order.

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

namespace weft {

/// Runs tasks one after another in a thread of its own, which keeps its memory from one to the
/// next. Thread-safe. The destructor finishes what was handed in.
class WorkThread {
  public:
    WorkThread() : thread_([this] { loop(); }) {}
    ~WorkThread();
    WorkThread(const WorkThread&) = delete;
    WorkThread& operator=(const WorkThread&) = delete;

    /// Hands in a task. The future gives its result or its exception.
    template <class Task>
    [[nodiscard]] auto run(Task task) {
        using Result = decltype(task());
        auto packaged = std::make_shared<std::packaged_task<Result()>>(std::move(task));
        auto result = packaged->get_future();
        add([packaged] { (*packaged)(); });
        return result;
    }

  private:
    void add(std::function<void()> task);
    void loop();

    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<std::function<void()>> tasks_;
    bool stop_ = false;
    std::thread thread_;  // started last
};

}  // namespace weft

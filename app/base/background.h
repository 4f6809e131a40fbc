#pragma once
// Work that gives way to the window.

#include <future>
#include <type_traits>
#include <utility>

namespace weft {

/// The calling thread, and threads and processes that it starts, run at a lower priority from now
/// on.
void lower_thread_priority();

/// Without a window there is nothing to give way to: threads that start from now on keep their
/// priority. For scripts and tests; before the first session.
void keep_thread_priority();

/// Runs `work` in a thread of its own at that lower priority.
template <class F>
[[nodiscard]] std::future<std::invoke_result_t<std::decay_t<F>>> in_background(F&& work) {
    return std::async(std::launch::async, [work = std::forward<F>(work)]() mutable {
        lower_thread_priority();
        return work();
    });
}

}  // namespace weft

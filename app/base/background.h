#pragma once
// Background work at a lower priority than the window.

#include <future>
#include <type_traits>
#include <utility>

namespace weft {

/// Lowers the priority of the calling thread and of threads and processes that it starts later.
void lower_thread_priority();

/// Keeps the priority of threads that start from now on, because no window competes with them. For
/// scripts and tests; call it before the first session.
void keep_thread_priority();

/// Runs `work` in a new thread at that lower priority.
template <class F>
[[nodiscard]] std::future<std::invoke_result_t<std::decay_t<F>>> in_background(F&& work) {
    return std::async(std::launch::async, [work = std::forward<F>(work)]() mutable {
        lower_thread_priority();
        return work();
    });
}

/// Runs `work` in a new thread at the priority of the window: what the hand waits for, shortly.
template <class F>
[[nodiscard]] std::future<std::invoke_result_t<std::decay_t<F>>> at_hand(F&& work) {
    return std::async(std::launch::async, std::forward<F>(work));
}

}  // namespace weft

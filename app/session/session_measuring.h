#pragma once
// Internal to the session: a measurement in progress.

#include <atomic>
#include <mutex>
#include <thread>

#include "app/session/session_view.h"

namespace weft {

struct Measuring {
    std::mutex mutex;
    QualityReport report;
    std::atomic<bool> cancelled{false};
    std::thread thread;
    ~Measuring() {
        cancelled = true;
        if (thread.joinable()) thread.join();
    }
};

}  // namespace weft

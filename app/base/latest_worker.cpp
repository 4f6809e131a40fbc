#include "app/base/latest_worker.h"

#include <cerrno>

#include "app/base/background.h"

namespace weft {

LatestThread::LatestThread(WorkerPriority priority) {
    sem_init(&posted_, 0, 0);
    thread_ = std::thread([this, priority] { run(priority); });
}

LatestThread::~LatestThread() {
    stop_ = true;
    sem_post(&posted_);
    thread_.join();
    sem_destroy(&posted_);
}

void LatestThread::post(Job job) {
    next_.put(std::make_unique<Job>(std::move(job)));
    sem_post(&posted_);
}

void LatestThread::run(WorkerPriority priority) {
    if (priority == WorkerPriority::kBackground) lower_thread_priority();
    for (;;) {
        while (sem_wait(&posted_) != 0 && errno == EINTR) {
        }
        if (stop_) return;
        // take() is empty if a newer job replaced the one that this wake-up was for.
        if (const auto job = next_.take()) (*job)();
    }
}

}  // namespace weft

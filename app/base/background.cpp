#include "app/base/background.h"

#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>

namespace weft {
namespace {

std::atomic<bool> gives_way = true;

}  // namespace

void keep_thread_priority() {
    gives_way = false;
}

void lower_thread_priority() {
    if (!gives_way) return;
    // On Linux, nice values are per thread. Failing to set one costs only smoothness. 10 gives a
    // ninth of the window's share of the processor. 19 would be too low: memory mapping takes a
    // lock of the whole process, and a thread that rarely runs would hold it for too long.
    constexpr int kNice = 10;
    (void)setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kNice);
    // SCHED_BATCH: a thread that wakes up does not preempt the thread that draws.
    const sched_param none{};
    (void)sched_setscheduler(0, SCHED_BATCH, &none);
}

}  // namespace weft

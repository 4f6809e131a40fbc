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
    // On Linux a nice value belongs to a thread; where it cannot be set, nothing is lost but some
    // smoothness. 10 is a ninth of the window's share. Not 19: memory is mapped under a lock of the
    // whole process, and a thread that is hardly ever run would keep it for as long.
    constexpr int kNice = 10;
    (void)setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kNice);
    // Waking up, it does not interrupt what draws.
    const sched_param none{};
    (void)sched_setscheduler(0, SCHED_BATCH, &none);
}

}  // namespace weft

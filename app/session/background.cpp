#include "app/session/background.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace weft {

void lower_thread_priority() {
    // On Linux a nice value belongs to a thread; where it cannot be set, nothing is lost but some
    // smoothness. Not lower: on a crowded machine a thread that is hardly ever run keeps the locks
    // that the window waits for.
    constexpr int kNice = 4;
    (void)setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kNice);
}

}  // namespace weft

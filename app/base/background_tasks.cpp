#include "app/base/background_tasks.h"

#include <chrono>

namespace weft {

void BackgroundTasks::finish(bool wait) {
    for (std::size_t k = 0; k < tasks_.size();) {
        if (!wait && tasks_[k].wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
            ++k;
            continue;
        }
        const Finish finish = tasks_[k].get();
        tasks_.erase(tasks_.begin() + static_cast<std::ptrdiff_t>(k));
        finish();
    }
}

}  // namespace weft

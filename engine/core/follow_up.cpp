#include "engine/core/follow_up.h"

#include <utility>

#include "engine/core/parallel.h"

namespace weft {

Status FollowUp::run(std::function<Status()> work) {
    WEFT_CHECK_OK(finish());
    if (thread_count() == 1) return work();
    if (!thread_) thread_.emplace();
    running_ = thread_->run(std::move(work));
    return {};
}

Status FollowUp::finish() {
    return running_.valid() ? running_.get() : Status{};
}

}  // namespace weft

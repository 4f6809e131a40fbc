#include "engine/pipeline/matte_feed.h"

#include <utility>

namespace weft {

bool MatteFeed::Face::has(const AnalysisKey& key) const {
    return feed_.store_.has(key);
}

Status MatteFeed::Face::put(const AnalysisKey& key, const Bytes& bytes) {
    return feed_.store_.put(key, bytes);
}

Expected<Bytes> MatteFeed::Face::get(const AnalysisKey& key) const {
    return feed_.store_.get(key);
}

Status MatteFeed::Maker::put(const AnalysisKey& key, const Bytes& bytes) {
    WEFT_CHECK_OK(Face::put(key, bytes));
    return key.kind == AnalysisKind::kMatte ? feed_.wait_until_wanted(key.frame) : Status{};
}

Expected<Bytes> MatteFeed::Taker::get(const AnalysisKey& key) const {
    if (key.kind == AnalysisKind::kMatte) WEFT_CHECK_OK(feed_.wait_for(key));
    return Face::get(key);
}

Status MatteFeed::wait_until_wanted(int frame) {
    std::unique_lock lock(mutex_);
    not_asked_for_.insert(frame);
    changed_.notify_all();
    changed_.wait(lock, [&] {
        return released_ || waiting_ > 0 || static_cast<int>(not_asked_for_.size()) <= kMostAhead;
    });
    if (abandoned_) return fail(ErrorCode::kTerminated, "The mattes are not needed any more.");
    return {};
}

Status MatteFeed::wait_for(const AnalysisKey& key) {
    std::unique_lock lock(mutex_);
    not_asked_for_.erase(key.frame);
    ++waiting_;
    changed_.notify_all();
    changed_.wait(lock, [&] { return made_ || store_.has(key); });
    --waiting_;
    return made_ && !store_.has(key) ? *made_ : Status{};
}

void MatteFeed::end(Status made) {
    const std::lock_guard lock(mutex_);
    made_ = std::move(made);
    changed_.notify_all();
}

void MatteFeed::release(bool failed) {
    const std::lock_guard lock(mutex_);
    released_ = true;
    abandoned_ = failed && !made_;
    changed_.notify_all();
}

Status MatteFeed::made() const {
    const std::lock_guard lock(mutex_);
    return made_ && !abandoned_ ? *made_ : Status{};
}

}  // namespace weft

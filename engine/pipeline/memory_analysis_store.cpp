#include <mutex>
#include <string>

#include "engine/pipeline/analysis_store.h"

namespace weft {

bool MemoryAnalysisStore::has(const AnalysisKey& key) const {
    const std::lock_guard lock(mutex_);
    return blobs_.contains(key);
}

Status MemoryAnalysisStore::put(const AnalysisKey& key, const Bytes& bytes) {
    const std::lock_guard lock(mutex_);
    blobs_[key] = bytes;
    return {};
}

Expected<Bytes> MemoryAnalysisStore::get(const AnalysisKey& key) const {
    const std::lock_guard lock(mutex_);
    const auto found = blobs_.find(key);
    if (found == blobs_.end()) {
        return fail(ErrorCode::kRenderFailed,
                    "Frame " + std::to_string(key.frame) + " has not been analysed.");
    }
    return found->second;
}

}  // namespace weft

#include "engine/media/frame_cache.h"

#include <future>
#include <list>
#include <map>
#include <mutex>
#include <new>
#include <utility>

namespace weft {
namespace {

using SharedFrame = Expected<std::shared_ptr<const PlateFrame>>;

std::size_t bytes_of(const PlateFrame& frame) {
    return frame.rgb.size_bytes() + frame.alpha.size_bytes() + sizeof frame;
}

// Other threads may wait for this decoding, so running out of memory is returned as a result.
SharedFrame decode(const FrameReader& reader, int frame) {
    try {
        WEFT_TRY(pixels, reader.read(frame));
        return std::make_shared<const PlateFrame>(std::move(pixels));
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::kNoSpace, reader.path_of(frame) + " does not fit into memory.");
    }
}

}  // namespace

struct CachedReader::State {
    struct Kept {
        int frame;
        Hash128 stamp;
        std::shared_ptr<const PlateFrame> pixels;
    };
    // A decoding in progress. The key includes the stamp, so that a request after the file has
    // changed does not get the old picture.
    using Key = std::pair<int, Hash128>;

    std::size_t budget_bytes = 0;
    std::mutex mutex;
    std::list<Kept> kept;  // latest used first
    std::size_t kept_bytes = 0;
    std::map<Key, std::shared_future<SharedFrame>> decoding;

    std::shared_ptr<const PlateFrame> find(int frame, const Hash128& stamp) {
        for (auto it = kept.begin(); it != kept.end(); ++it) {
            if (it->frame != frame) continue;
            if (it->stamp == stamp) {
                kept.splice(kept.begin(), kept, it);
                return it->pixels;
            }
            drop(it);
            return nullptr;
        }
        return nullptr;
    }

    void keep(int frame, const Hash128& stamp, const std::shared_ptr<const PlateFrame>& pixels) {
        if (bytes_of(*pixels) > budget_bytes) return;
        for (auto it = kept.begin(); it != kept.end(); ++it) {
            if (it->frame == frame) {
                drop(it);
                break;
            }
        }
        kept.push_front({frame, stamp, pixels});
        kept_bytes += bytes_of(*pixels);
        while (kept_bytes > budget_bytes)
            drop(std::prev(kept.end()));
    }

    void drop(std::list<Kept>::iterator it) {
        kept_bytes -= bytes_of(*it->pixels);
        kept.erase(it);
    }
};

CachedReader::CachedReader(std::shared_ptr<const FrameReader> reader, std::size_t budget_bytes)
    : reader_(std::move(reader)), state_(std::make_unique<State>()) {
    state_->budget_bytes = budget_bytes;
}

CachedReader::~CachedReader() = default;

SharedFrame CachedReader::read_shared(int frame) const {
    WEFT_TRY(stamp, reader_->stamp(frame));
    std::promise<SharedFrame> promise;
    std::shared_future<SharedFrame> other;
    {
        const std::lock_guard lock(state_->mutex);
        if (auto pixels = state_->find(frame, stamp)) return pixels;
        const auto [it, mine] = state_->decoding.try_emplace({frame, stamp});
        if (mine) {
            it->second = promise.get_future().share();
        } else {
            other = it->second;
        }
    }
    if (other.valid()) return other.get();

    SharedFrame result = decode(*reader_, frame);
    {
        const std::lock_guard lock(state_->mutex);
        if (result) state_->keep(frame, stamp, *result);
        state_->decoding.erase({frame, stamp});
    }
    promise.set_value(result);
    return result;
}

Expected<PlateFrame> CachedReader::read(int frame) const {
    WEFT_TRY(shared, read_shared(frame));
    return PlateFrame(*shared);
}

std::size_t CachedReader::size_bytes() const {
    const std::lock_guard lock(state_->mutex);
    return state_->kept_bytes;
}

std::shared_ptr<const CachedReader> cached(std::shared_ptr<const FrameReader> reader,
                                           std::size_t budget_bytes) {
    return std::make_shared<CachedReader>(std::move(reader), budget_bytes);
}

}  // namespace weft

#pragma once
// Decoded frames for viewing and playback: a bounded cache that background threads fill in the
// order in which the frames will be wanted.

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "app/base/picture.h"
#include "engine/media/frame_reader.h"

namespace weft {

/// Thread-safe. The window's thread asks with try_want() and try_read(), which never wait: a worker
/// of low priority may be interrupted while it holds the lock, for as long as a busy machine likes.
class PlatePlayer {
  public:
    enum class State : std::uint8_t { kEmpty, kCached, kFailed };
    /// What there is, as of the last try_read() that succeeded.
    struct Reading {
        int frame = 0;
        PicturePtr picture;         ///< Of `frame`; null when it is not decoded (yet).
        std::string error;          ///< Why `frame` could not be read.
        std::vector<State> states;  ///< By index into the reader's frames.
        std::size_t bytes = 0;
        std::uint64_t changes = 0;  ///< Of `states`; 0: never read.
    };

    /// `srgb` and `linear` take the plate's space to the screen's; null: it is there already.
    PlatePlayer(std::shared_ptr<const FrameReader> reader,
                std::shared_ptr<const ColorTransform> srgb,
                std::shared_ptr<const ColorTransform> linear, std::size_t budget_bytes);
    ~PlatePlayer();

    /// The frames wanted next, the most urgent first; replaces what was wanted before. Frames that
    /// are not among them go first when memory is short.
    /// False, and nothing happens, when a worker is at the cache just now.
    bool try_want(const std::vector<int>& frames);
    /// Likewise. `reading` may be that of another frame: only what differs is filled in.
    bool try_read(int frame, Reading& reading) const;
    /// Grows whenever a frame arrives: what tells a waiting window to draw again.
    [[nodiscard]] std::uint64_t changes() const { return changes_.load(); }

  private:
    void work();
    [[nodiscard]] bool next_frame(int& frame);
    void keep(int frame, Expected<PlateFrame> decoded);
    /// What has to go, to be freed without the lock.
    [[nodiscard]] std::vector<PicturePtr> make_room(std::size_t bytes);

    std::shared_ptr<const FrameReader> reader_;
    std::shared_ptr<const ColorTransform> srgb_, linear_;
    const std::size_t budget_bytes_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::vector<int> wanted_;
    std::map<int, PicturePtr> pictures_;
    std::map<int, std::string> errors_;
    std::vector<int> decoding_;
    std::size_t bytes_ = 0;
    std::atomic<std::uint64_t> changes_ = 0;
    bool stop_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace weft

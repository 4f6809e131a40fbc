#pragma once
// Decoded frames for viewing and playback: a bounded cache, filled by background threads in the
// order of use.

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

/// Thread-safe. The window's thread uses try_want() and try_read(), which never block: a
/// low-priority worker that holds the lock may be preempted for a long time on a busy machine.
class PlatePlayer {
  public:
    enum class State : std::uint8_t { kEmpty, kCached, kFailed };
    /// The state of the cache at the last successful try_read().
    struct Reading {
        int frame = 0;
        PicturePtr picture;         ///< Picture of `frame`; null if not decoded (yet).
        std::string error;          ///< Why `frame` could not be read.
        std::vector<State> states;  ///< State of each frame, by index into the reader's frames.
        std::size_t bytes = 0;
        std::uint64_t changes = 0;  ///< Change counter of `states`; 0: never read.
    };

    /// `srgb` and `linear` convert the plate's space to the display's; null: already there.
    PlatePlayer(std::shared_ptr<const FrameReader> reader,
                std::shared_ptr<const ColorTransform> srgb,
                std::shared_ptr<const ColorTransform> linear, std::size_t budget_bytes);
    ~PlatePlayer();

    /// Sets the frames wanted next, most urgent first; replaces the previous list. Frames that are
    /// not listed are freed first. Returns false and does nothing while a worker holds the lock.
    bool try_want(const std::vector<int>& frames);
    /// Updates `reading`, also one of another frame: only differences are written. Returns false
    /// and does nothing while a worker holds the lock.
    bool try_read(int frame, Reading& reading) const;
    /// Increases with every decoded frame, so that a waiting window redraws.
    [[nodiscard]] std::uint64_t changes() const { return changes_.load(); }

  private:
    void work();
    [[nodiscard]] bool next_frame(int& frame);
    void keep(int frame, Expected<PlateFrame> decoded);
    /// Removes pictures to make room; the caller frees them without the lock.
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

#pragma once
// Decoded frames for viewing and playback: a bounded cache that background threads fill in the
// order in which the frames will be wanted.

#include <condition_variable>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "app/session/picture.h"
#include "engine/media/frame_reader.h"

namespace weft {

/// Never blocks its caller: all functions return at once. Thread-safe.
class PlatePlayer {
  public:
    enum class State : std::uint8_t { kEmpty, kCached, kFailed };

    /// `srgb` and `linear` take the plate's space to the screen's; null: it is there already.
    PlatePlayer(std::shared_ptr<const FrameReader> reader,
                std::shared_ptr<const ColorTransform> srgb,
                std::shared_ptr<const ColorTransform> linear, std::size_t budget_bytes);
    ~PlatePlayer();

    /// The frames wanted next, the most urgent first; replaces what was wanted before. Frames that
    /// are not among them go first when memory is short.
    void want(std::vector<int> frames);
    /// Null when it is not decoded (yet).
    [[nodiscard]] PicturePtr get(int frame) const;
    [[nodiscard]] State state(int frame) const;
    /// Why a frame could not be read; empty when it could.
    [[nodiscard]] std::string error(int frame) const;
    [[nodiscard]] std::size_t size_bytes() const;
    [[nodiscard]] int cached_count() const;
    /// Grows whenever a frame arrives: what tells a waiting window to draw again.
    [[nodiscard]] std::uint64_t arrivals() const;

  private:
    void work();
    [[nodiscard]] bool next_frame(int& frame);
    void keep(int frame, Expected<PlateFrame> decoded);
    void make_room(std::size_t bytes);

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
    std::uint64_t arrivals_ = 0;
    bool stop_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace weft

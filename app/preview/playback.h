#pragma once
// The playhead and its movement.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "app/preview/plate_player.h"

namespace weft {

/// What follows the last frame of the range.
enum class PlayMode : std::uint8_t { kLoop, kPingPong, kOnce };

/// Belongs to one thread. Frames are the plate's frame numbers, ascending; indices count them from
/// 0.
class Playback {
  public:
    /// Sets the frames of a plate, at least one. The playhead stays, or moves to the first frame.
    void open(std::vector<int> frames);
    /// Closes the plate. The playhead's number is kept for the next one.
    void close();
    /// Stops, clears the in and out points, and begins the next plate at its first frame.
    void reset();

    [[nodiscard]] const std::vector<int>& frames() const { return frames_; }
    [[nodiscard]] int frame() const { return frame_; }
    /// 1: forwards; −1: backwards; 0: stopped.
    [[nodiscard]] int direction() const { return direction_; }
    /// Measured frame rate, frames/s; 0: not known.
    [[nodiscard]] double shown_fps() const { return shown_fps_; }

    /// The index of a frame, or of the next frame if the plate does not have it.
    [[nodiscard]] int index_of(int frame) const;
    [[nodiscard]] int index() const { return index_of(frame_); }
    /// The first and last index between in and out points, inclusive.
    [[nodiscard]] std::pair<int, int> range() const;
    [[nodiscard]] std::optional<int> mark_in() const { return mark_in_; }
    [[nodiscard]] std::optional<int> mark_out() const { return mark_out_; }
    [[nodiscard]] bool marked() const { return mark_in_ || mark_out_; }
    /// Sets in and out points, in either order.
    void mark(std::optional<int> in, std::optional<int> out);

    /// Moves the playhead to a frame of the plate. Returns true if it moved.
    bool go_to(int frame);
    /// Moves the playhead by `count` frames within the plate. Returns true if it moved.
    bool step(int count);
    void play(int direction);
    void stop() { direction_ = 0; }
    void set_mode(PlayMode mode) { mode_ = mode; }
    [[nodiscard]] PlayMode mode() const { return mode_; }

    /// Advances the playhead during playback. `decoded`: state of each frame by index; playback
    /// waits for a frame that is not decoded. `now_s`: a monotonic clock.
    void advance(double now_s, double fps, const std::vector<PlatePlayer::State>& decoded);
    /// The current frame and the next ones in the direction of playback.
    [[nodiscard]] std::vector<int> upcoming() const;

  private:
    std::vector<int> frames_;
    int frame_ = 0, direction_ = 0;
    PlayMode mode_ = PlayMode::kLoop;
    std::optional<int> mark_in_, mark_out_;
    double now_s_ = 0, frame_at_s_ = 0, fps_since_s_ = 0, shown_fps_ = 0;
    int shown_ = 0;        // frames since fps_since_s_
    bool begins_ = false;  // the next open() goes to the first frame
};

}  // namespace weft

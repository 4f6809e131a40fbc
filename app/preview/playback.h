#pragma once
// Where the playhead is, and how it moves.

#include <optional>
#include <utility>
#include <vector>

#include "app/preview/plate_player.h"

namespace weft {

/// One thread. Frames are the plate's numbers, ascending; indices count them from 0.
class Playback {
  public:
    /// The frames of a plate, at least one. The playhead stays where it is, or goes to the first.
    void open(std::vector<int> frames);
    /// There is no plate. The playhead's number stays for the next one.
    void close();
    /// Stops and forgets the marks.
    void reset();

    [[nodiscard]] const std::vector<int>& frames() const { return frames_; }
    [[nodiscard]] int frame() const { return frame_; }
    /// 1 forwards, −1 backwards, 0 not playing.
    [[nodiscard]] int direction() const { return direction_; }
    /// How many frames a second were shown lately; 0: not known.
    [[nodiscard]] double shown_fps() const { return shown_fps_; }

    /// The index of a frame, or of the one after it where the plate has not got it.
    [[nodiscard]] int index_of(int frame) const;
    [[nodiscard]] int index() const { return index_of(frame_); }
    /// The first and the last index between the marks, inclusive.
    [[nodiscard]] std::pair<int, int> range() const;
    [[nodiscard]] std::optional<int> mark_in() const { return mark_in_; }
    [[nodiscard]] std::optional<int> mark_out() const { return mark_out_; }
    [[nodiscard]] bool marked() const { return mark_in_ || mark_out_; }
    /// In either order.
    void mark(std::optional<int> in, std::optional<int> out);

    /// To a frame of the plate. Whether the playhead moved.
    bool go_to(int frame);
    /// By so many frames, within the plate. Likewise.
    bool step(int count);
    void play(int direction);
    void stop() { direction_ = 0; }

    /// Moves the playhead on while playing. `decoded`: of each frame, by index; one that is not
    /// decoded is waited for. `now_s`: a clock that never goes back.
    void advance(double now_s, double fps, const std::vector<PlatePlayer::State>& decoded);
    /// The present frame and those that will be shown next.
    [[nodiscard]] std::vector<int> upcoming() const;

  private:
    std::vector<int> frames_;
    int frame_ = 0, direction_ = 0;
    std::optional<int> mark_in_, mark_out_;
    double now_s_ = 0, frame_at_s_ = 0, fps_since_s_ = 0, shown_fps_ = 0;
    int shown_ = 0;  // frames since fps_since_s_
};

}  // namespace weft

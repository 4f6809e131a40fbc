#pragma once
// When the window draws: at once on events, often while the hand is at work, less often while
// something is waited for, and otherwise hardly ever. Where the driver does not wait for the
// screen, frames would follow each other without a pause and take the processors from the work they
// show.

#include <cstdint>

namespace weft {

/// What the window knows between two frames; times in s.
struct WindowMoment {
    double now_s = 0;
    bool event = false;         ///< Input or exposure since the last frame.
    bool at_hand = false;       ///< A button is down, input waits, or the shot is played.
    bool busy = false;          ///< Something is being worked on, or a text is being typed.
    bool passing = false;       ///< Something is shown that goes by itself, or takes long.
    std::uint64_t changes = 0;  ///< Of what is shown.
};

class FramePace {
  public:
    /// How long to wait for events; 0: not at all.
    [[nodiscard]] double wait_s(const WindowMoment& moment) const;
    /// Whether to draw a frame now. Call it once after each wait.
    [[nodiscard]] bool draws(const WindowMoment& moment);

  private:
    [[nodiscard]] bool rests(const WindowMoment& moment) const;

    double drawn_s_ = 0, event_s_ = -1;
    std::uint64_t seen_ = 0;
    bool settles_ = false;  // after a change
    int left_ = 3;          // ImGui needs a few frames to settle after an event
};

}  // namespace weft

#pragma once
// Queues events between frames so that ImGui loses none: a key that is pressed and released between
// two frames is down in one frame and up in the next.

#include <imgui.h>

#include <deque>
#include <vector>

namespace weft {

/// ImGui 1.86 samples keys and buttons once per frame and has no event queue. Belongs to one
/// thread.
class InputQueue {
  public:
    /// `key`: a GLFW key code. `at_s`: time of the event on a monotonic clock.
    void key(int key, bool down);
    void character(unsigned code);
    void button(int button, bool down, double at_s);
    void move(ImVec2 to);
    /// Whether the mouse has moved in the window since it entered.
    [[nodiscard]] bool knows_mouse() const { return newest_.x > -FLT_MAX; }
    void wheel(float x, float y);
    /// The mouse left the window.
    void leave();
    /// The window lost focus: releases all keys, because their release will not be reported.
    void release_all();

    /// Call before ImGui::NewFrame(): passes on events in order, at most one change per key or
    /// button, with the mouse where the button changed. The rest waits for the next frames.
    void feed(ImGuiIO& io);
    [[nodiscard]] bool pending() const { return !events_.empty(); }
    /// Path of the mouse in this frame while the left button was down, for drawing tools.
    [[nodiscard]] const std::vector<ImVec2>& path() const { return path_; }

  private:
    struct Event {
        enum class Kind { kKey, kCharacter, kButton, kMove, kWheel } kind = Kind::kKey;
        int code = 0;
        bool down = false;
        ImVec2 at{0, 0};
        double at_s = 0;
    };
    /// Events passed on in this frame.
    struct Had {
        bool key = false, named_key = false, character = false;
        bool button = false, moved = false, wheel = false;
        std::vector<int> keys, buttons;
    };
    [[nodiscard]] static bool must_wait(const Event& event, const Had& had);
    void hand_over(const Event& event, Had& had, ImGuiIO& io);
    [[nodiscard]] bool second_click(const Event& press);

    std::deque<Event> events_;
    std::vector<ImVec2> path_;
    ImVec2 mouse_{-FLT_MAX, -FLT_MAX}, newest_ = mouse_;  // as passed on, and as queued
    bool down_[ImGuiMouseButton_COUNT] = {};
    struct Press {
        double at_s = -1;
        ImVec2 at{0, 0};
        bool second = false;
    };
    Press last_press_[ImGuiMouseButton_COUNT];
};

}  // namespace weft

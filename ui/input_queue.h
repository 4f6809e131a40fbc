#pragma once
// What the window system reports between two frames, given to ImGui so that nothing is lost: a key
// that is pressed and released between two frames is down in one and up in the next.

#include <imgui.h>

#include <deque>
#include <vector>

namespace weft {

/// ImGui 1.86 looks at the state of keys and buttons once a frame and has no queue of its own. One
/// thread.
class InputQueue {
  public:
    /// `key`: a GLFW key code. `at_s`: when it happened, on a clock that never goes back.
    void key(int key, bool down);
    void character(unsigned code);
    void button(int button, bool down, double at_s);
    void move(ImVec2 to);
    void wheel(float x, float y);
    /// The mouse left the window.
    void leave();
    /// The keyboard went elsewhere: what is down will be reported to nobody.
    void release_all();

    /// Before ImGui::NewFrame(): hands over events in their order, at most one change of a key or a
    /// button each, a button always where the mouse was then. The rest waits for the next frames.
    void feed(ImGuiIO& io);
    [[nodiscard]] bool pending() const { return !events_.empty(); }
    /// Where the mouse went in this frame while the left button was down, for tools that draw.
    [[nodiscard]] const std::vector<ImVec2>& path() const { return path_; }

  private:
    struct Event {
        enum class Kind { kKey, kCharacter, kButton, kMove, kWheel } kind = Kind::kKey;
        int code = 0;
        bool down = false;
        ImVec2 at{0, 0};
        double at_s = 0;
    };
    /// What this frame has had so far.
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
    ImVec2 mouse_{-FLT_MAX, -FLT_MAX};
    bool down_[ImGuiMouseButton_COUNT] = {};
    struct Press {
        double at_s = -1;
        ImVec2 at{0, 0};
        bool second = false;
    };
    Press last_press_[ImGuiMouseButton_COUNT];
};

}  // namespace weft

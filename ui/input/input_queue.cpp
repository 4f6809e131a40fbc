#include "ui/input/input_queue.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

// GLFW key codes.
constexpr int kFirstNamed = 256;  // Esc, Enter, arrows, …: keys without a character
constexpr int kLeftShift = 340, kLeftControl = 341, kLeftAlt = 342, kLeftSuper = 343;
constexpr int kRightShift = 344, kRightControl = 345, kRightAlt = 346, kRightSuper = 347;

constexpr double kDoubleClickS = 0.35;
constexpr float kDoubleClickPx = 6;

bool is_modifier(int key) {
    return key >= kLeftShift && key <= kRightSuper;
}

bool holds(const std::vector<int>& list, int code) {
    return std::find(list.begin(), list.end(), code) != list.end();
}

}  // namespace

void InputQueue::key(int key, bool down) {
    if (key >= 0 && key < IM_ARRAYSIZE(ImGuiIO::KeysDown))
        events_.push_back({Event::Kind::kKey, key, down, {}, 0});
}

void InputQueue::character(unsigned code) {
    events_.push_back({Event::Kind::kCharacter, static_cast<int>(code), false, {}, 0});
}

void InputQueue::button(int button, bool down, double at_s) {
    if (button >= 0 && button < ImGuiMouseButton_COUNT)
        events_.push_back({Event::Kind::kButton, button, down, {}, at_s});
}

void InputQueue::move(ImVec2 to) {
    newest_ = to;
    events_.push_back({Event::Kind::kMove, 0, false, to, 0});
}

void InputQueue::wheel(float x, float y) {
    events_.push_back({Event::Kind::kWheel, 0, false, {x, y}, 0});
}

void InputQueue::leave() {
    // A drag continues outside the window.
    if (std::none_of(std::begin(down_), std::end(down_), [](bool down) { return down; }))
        move({-FLT_MAX, -FLT_MAX});
}

void InputQueue::release_all() {
    const ImGuiIO& io = ImGui::GetIO();
    for (int code = 0; code < IM_ARRAYSIZE(io.KeysDown); ++code)
        if (io.KeysDown[code]) key(code, false);
    for (int b = 0; b < ImGuiMouseButton_COUNT; ++b)
        if (down_[b]) button(b, false, 0);
}

bool InputQueue::must_wait(const Event& event, const Had& had) {
    switch (event.kind) {
        case Event::Kind::kKey:
            if (holds(had.keys, event.code)) return true;
            // A key needs its modifiers down in the same frame; a click needs those held at the
            // time.
            if (is_modifier(event.code)) return had.key || had.button || had.character;
            return had.button || (had.character && event.code >= kFirstNamed);
        case Event::Kind::kCharacter:
            return had.named_key || had.button;
        case Event::Kind::kButton:
            return holds(had.buttons, event.code) || had.key || had.wheel;
        case Event::Kind::kMove:
            return had.button || had.wheel;
        case Event::Kind::kWheel:
            return had.button || had.key;
    }
    return false;
}

// ImGui measures double clicks by frame times, and two frames may be further apart than the two
// clicks.
bool InputQueue::second_click(const Event& press) {
    Press& last = last_press_[press.code];
    const bool near = std::hypot(mouse_.x - last.at.x, mouse_.y - last.at.y) < kDoubleClickPx;
    const bool second =
        !last.second && last.at_s >= 0 && press.at_s - last.at_s < kDoubleClickS && near;
    last = {press.at_s, mouse_, second};
    return second;
}

void InputQueue::hand_over(const Event& event, Had& had, ImGuiIO& io) {
    switch (event.kind) {
        case Event::Kind::kKey:
            io.KeysDown[event.code] = event.down;
            had.keys.push_back(event.code);
            if (is_modifier(event.code)) break;
            had.key = true;
            had.named_key |= event.code >= kFirstNamed;
            break;
        case Event::Kind::kCharacter:
            io.AddInputCharacter(static_cast<unsigned>(event.code));
            had.character = true;
            break;
        case Event::Kind::kButton:
            down_[event.code] = event.down;
            had.buttons.push_back(event.code);
            had.button = true;
            if (event.down) io.MouseDoubleClickTime = second_click(event) ? FLT_MAX : 0.0f;
            break;
        case Event::Kind::kMove:
            mouse_ = event.at;
            had.moved = true;
            if (down_[0]) path_.push_back(mouse_);
            break;
        case Event::Kind::kWheel:
            io.MouseWheelH += event.at.x;
            io.MouseWheel += event.at.y;
            had.wheel = true;
            break;
    }
}

void InputQueue::feed(ImGuiIO& io) {
    Had had;
    path_.clear();
    while (!events_.empty() && !must_wait(events_.front(), had)) {
        hand_over(events_.front(), had, io);
        events_.pop_front();
    }
    io.MousePos = mouse_;
    std::copy(std::begin(down_), std::end(down_), std::begin(io.MouseDown));
    io.KeyCtrl = io.KeysDown[kLeftControl] || io.KeysDown[kRightControl];
    io.KeyShift = io.KeysDown[kLeftShift] || io.KeysDown[kRightShift];
    io.KeyAlt = io.KeysDown[kLeftAlt] || io.KeysDown[kRightAlt];
    io.KeySuper = io.KeysDown[kLeftSuper] || io.KeysDown[kRightSuper];
}

}  // namespace weft

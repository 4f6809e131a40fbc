#include "ui/shell/robot.h"

namespace weft {

Robot::Robot(Shell& shell, std::function<void()> frame) : shell_(shell), frame_(std::move(frame)) {
    shell_.record_items(true);
}

void Robot::frames(int count) {
    for (int k = 0; k < count; ++k)
        frame_();
}

const DrawnItem* Robot::find(const std::string& name) const {
    const auto& items = shell_.items();
    for (auto item = items.rbegin(); item != items.rend(); ++item)
        if (item->name == name || item->name.ends_with("/" + name)) return &*item;
    return nullptr;
}

void Robot::move(ImVec2 to) {
    ImGui::GetIO().MousePos = to;
    frames();
}

void Robot::press(int button) {
    ImGui::GetIO().MouseDown[button] = true;
    frames();
}

void Robot::release(int button) {
    ImGui::GetIO().MouseDown[button] = false;
    frames();
}

bool Robot::hover(const std::string& name) {
    const DrawnItem* item = find(name);
    if (!item) return false;
    const ImVec2 middle((item->min.x + item->max.x) / 2, (item->min.y + item->max.y) / 2);
    move(middle);
    frames();
    return true;
}

bool Robot::click(const std::string& name, int times) {
    if (!hover(name)) return false;
    for (int k = 0; k < times; ++k) {
        press();
        release();
    }
    frames();
    return true;
}

bool Robot::drag(const std::string& name, ImVec2 by) {
    if (!hover(name)) return false;
    const ImVec2 from = ImGui::GetIO().MousePos;
    press();
    constexpr int kSteps = 8;
    for (int k = 1; k <= kSteps; ++k) {
        const float part = static_cast<float>(k) / kSteps;
        move({from.x + by.x * part, from.y + by.y * part});
    }
    release();
    frames();
    return true;
}

bool Robot::drag_onto(const std::string& from, const std::string& to) {
    const DrawnItem* source = find(from);
    const DrawnItem* target = find(to);
    if (!source || !target) return false;
    const ImVec2 a((source->min.x + source->max.x) / 2, (source->min.y + source->max.y) / 2);
    const ImVec2 b((target->min.x + target->max.x) / 2, (target->min.y + target->max.y) / 2);
    return drag(from, {b.x - a.x, b.y - a.y});
}

void Robot::wheel(float steps) {
    ImGui::GetIO().MouseWheel = steps;
    frames();
    ImGui::GetIO().MouseWheel = 0;
}

void Robot::hold(const std::string& chord, bool down) {
    const auto parsed = parse_chord(chord);
    if (!parsed) return;
    ImGuiIO& io = ImGui::GetIO();
    if (parsed->ctrl) io.KeyCtrl = down;
    if (parsed->shift) io.KeyShift = down;
    if (parsed->alt) io.KeyAlt = down;
    if (parsed->key) io.KeysDown[parsed->key] = down;
}

bool Robot::key(const std::string& chord) {
    if (!parse_chord(chord)) return false;
    hold(chord, true);
    frames();
    hold(chord, false);
    frames();
    return true;
}

void Robot::type(const std::string& text) {
    ImGui::GetIO().AddInputCharactersUTF8(text.c_str());
    frames(2);
}

void Robot::stroke(const std::vector<ImVec2>& points) {
    if (points.empty()) return;
    move(points.front());
    press();
    for (const ImVec2 point : points)
        move(point);
    release();
    frames();
}

}  // namespace weft

// Handles of pins and lamps in the viewer.
#include "ui/viewer_handles.h"
#include "ui/angles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/viewer.h"
#include "ui/widgets.h"

namespace weft::ui {
namespace {

PlatePoint plate_point(Vec2 p) {
    return {static_cast<double>(p.x), static_cast<double>(p.y)};
}
Vec2 place_of(PlatePoint p) {
    return {static_cast<float>(p.x), static_cast<float>(p.y)};
}

void line(Ctx& c, const ViewMap& map, Vec2 from, Vec2 to, ImU32 color) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine(map.to_screen(from), map.to_screen(to), IM_COL32(0, 0, 0, 160), c.theme.px(3));
    list.AddLine(map.to_screen(from), map.to_screen(to), color, c.theme.px(1.5f));
}

// The text beside a handle, legible on any picture.
void tag(Ctx& c, ImVec2 at, const char* text) {
    const Theme& t = c.theme;
    const float w = t.small->CalcTextSizeA(t.small->FontSize, FLT_MAX, 0, text).x;
    const ImVec2 min(at.x + t.px(10), at.y - t.px(9)), max(min.x + w + t.px(8), at.y + t.px(9));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(min, max, t.scrim, t.radius);
    text_in(list, t.small, min, max, t.text, text);
}

}  // namespace

Grip handle(Ctx& c, const ViewMap& map, const std::string& id, Vec2& at, bool hovered, ImU32 color,
            bool filled) {
    UiState& s = c.state;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    Grip grip = Grip::kNone;
    if (s.handle_held == id) {
        at = map.to_plate(mouse) + s.handle_offset;
        grip = ImGui::IsMouseDown(0) ? Grip::kHeld : Grip::kLetGo;
        if (grip == Grip::kLetGo) s.handle_held.clear();
    } else {
        const ImVec2 here = map.to_screen(at);
        const bool near = hovered && std::hypot(here.x - mouse.x, here.y - mouse.y) < c.theme.px(9);
        if (near && s.handle_held.empty()) {
            grip = Grip::kNear;
            if (ImGui::IsMouseClicked(0)) {
                s.handle_held = id;
                s.handle_offset = at - map.to_plate(mouse);
                grip = Grip::kTaken;
            }
        }
    }
    const ImVec2 on = map.to_screen(at);
    const float r = c.theme.px(grip == Grip::kNone ? 4.5f : 6.0f);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddCircleFilled(on, r + c.theme.px(1.5f), IM_COL32(0, 0, 0, 170), 20);
    if (filled)
        list.AddCircleFilled(on, r, color, 20);
    else
        list.AddCircle(on, r, color, 20, c.theme.px(1.5f));
    c.note("Handle " + id, {on.x - r, on.y - r}, {on.x + r, on.y + r});
    if (grip != Grip::kNone) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    return grip;
}

bool breaks_off() {
    const ImGuiIO& io = ImGui::GetIO();
    return io.KeyAlt || (io.KeyCtrl && io.KeyShift);
}

Vec2 arrow_step() {
    KeyChord pressed = pressed_chord(true);
    const float step = pressed.shift ? 10 : 1;
    pressed.shift = false;
    if (pressed == *parse_chord("Left")) return {-step, 0};
    if (pressed == *parse_chord("Right")) return {step, 0};
    if (pressed == *parse_chord("Up")) return {0, -step};
    if (pressed == *parse_chord("Down")) return {0, step};
    return {0, 0};
}

bool any_handle_held(const Ctx& c) {
    return !c.state.handle_held.empty();
}

bool take_back_drag(Ctx& c) {
    UiState& s = c.state;
    const bool transforms = s.transform.drag != TransformState::Drag::kNone;
    if (!any_handle_held(c) && !transforms && !s.warp.box_from && !s.brush.lassoing) return false;
    if (ImGui::GetIO().WantTextInput || !ImGui::IsKeyPressed(256)) return false;
    s.handle_held.clear();
    s.transform.drag = TransformState::Drag::kNone;
    s.warp.before.reset();
    s.warp.box_from.reset();
    s.shape_box.from.reset();
    s.shape_box.scale = 1;
    s.shape_box.radians = 0;
    if (std::exchange(s.brush.lassoing, false)) s.brush.outline.clear();
    c.drop_tried();
    return true;
}

// A click pins the texture in place; a drag moves it to where it belongs.
void pin_tool(Ctx& c, const ViewMap& map, bool hovered, bool active) {
    const Region* region = c.view.selected_region();
    if (!region) return;
    const int frame = c.view.frame;
    const RegionRef ref{region->id, {}};
    if (!any_handle_held(c)) {
        const auto found = region->corrections.find(frame);
        c.state.pins =
            found == region->corrections.end() ? std::vector<CorrectionPin>{} : found->second;
    }
    std::vector<CorrectionPin>& pins = c.state.pins;
    bool over = false;
    for (std::size_t k = 0; k < pins.size(); ++k) {
        Vec2 to = place_of(pins[k].to);
        if (!(pins[k].from == pins[k].to))
            line(c, map, place_of(pins[k].from), to, c.theme.accent_hover);
        const Grip grip = handle(c, map, "pin " + std::to_string(k + 1), to, hovered,
                                 c.theme.accent_hover, !(pins[k].from == pins[k].to));
        over |= grip != Grip::kNone;
        if (grip == Grip::kTaken && subtracts()) {
            c.state.handle_held.clear();
            pins.erase(pins.begin() + static_cast<std::ptrdiff_t>(k));
            c.edit(SetCorrection{ref, frame, pins});
            return;
        }
        if (grip != Grip::kHeld && grip != Grip::kLetGo) continue;
        pins[k].to = plate_point(to);
        if (grip == Grip::kLetGo)
            c.edit(SetCorrection{ref, frame, pins});
        else
            c.emit(TryEdit{SetCorrection{ref, frame, pins}});
    }
    if (over || !active || !ImGui::IsMouseClicked(0) || any_handle_held(c)) return;
    const Vec2 at = map.to_plate(ImGui::GetIO().MousePos);
    pins.push_back({plate_point(at), plate_point(at)});
    c.state.handle_held = "pin " + std::to_string(pins.size());
    c.state.handle_offset = {0, 0};
    c.emit(TryEdit{SetCorrection{ref, frame, pins}});
}

// ---- lamps -----------------------------------------------------------------------------------

namespace {

void set_lamp(Ctx& c, const Region& region, std::size_t index, const std::vector<float>& numbers,
              bool final) {
    std::vector<Lamp> lamps = region.light.lamps;
    set_numbers(lamps[index], c.view.frame, {numbers.begin(), numbers.end()});
    const SetRegionParameter set{{region.id, {}}, "light.lamps", std::move(lamps)};
    if (final)
        c.edit(set);
    else
        c.emit(TryEdit{set});
}

// A handle for two numbers of a lamp that are a point on the plate.
bool place_handle(Ctx& c, const ViewMap& map, const std::string& id, std::vector<float>& n,
                  std::size_t x, bool hovered, ImU32 color, Grip& grip) {
    Vec2 at{n[x], n[x + 1]};
    const Grip now = handle(c, map, id, at, hovered, color);
    if (now == Grip::kHeld || now == Grip::kLetGo) {
        n[x] = at.x;
        n[x + 1] = at.y;
        grip = now;
        return true;
    }
    return now == Grip::kTaken;
}

}  // namespace

void lamp_tool(Ctx& c, const ViewMap& map, bool hovered) {
    const Region* region = c.view.selected_region();
    if (!region || region->light.source != LightSource::kPainted) return;
    const std::vector<Lamp>& lamps = region->light.lamps;
    const Size plate = c.view.plate.size;
    const Vec2 middle{static_cast<float>(plate.width) / 2, static_cast<float>(plate.height) / 2};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (std::size_t k = 0; k < lamps.size(); ++k) {
        std::vector<float> n = lamps[k].numbers.float_at(c.view.frame);
        const std::string id = "lamp " + std::to_string(k + 1);
        const ImU32 color = c.state.lamp == static_cast<int>(k) ? c.theme.warn : c.theme.text;
        Grip grip = Grip::kNone;
        bool taken = false;
        if (lamps[k].kind == LampKind::kPoint) {
            const Vec2 at{n[0], n[1]};
            list.AddCircle(map.to_screen(at), n[2] * map.zoom, faded(color, 0.7f), 64,
                           c.theme.px(1.5f));
            Vec2 rim{n[0] + n[2], n[1]};
            const Grip on_rim = handle(c, map, id + " radius", rim, hovered, color, false);
            if (on_rim == Grip::kHeld || on_rim == Grip::kLetGo) {
                n[2] = std::max(4.0f, std::hypot(rim.x - n[0], rim.y - n[1]));
                grip = on_rim;
            }
            taken = on_rim == Grip::kTaken;
            taken |= place_handle(c, map, id, n, 0, hovered, color, grip);
        } else if (lamps[k].kind == LampKind::kGradient) {
            line(c, map, {n[0], n[1]}, {n[2], n[3]}, faded(color, 0.7f));
            taken = place_handle(c, map, id + " start", n, 0, hovered, color, grip);
            taken |= place_handle(c, map, id + " end", n, 2, hovered, color, grip);
        } else {
            const float reach = 0.3f * static_cast<float>(std::min(plate.width, plate.height));
            const auto angle = static_cast<float>(static_cast<double>(n[0]) * kDegree);
            Vec2 from = middle + Vec2{std::cos(angle), -std::sin(angle)} * reach;
            line(c, map, from, middle, faded(color, 0.7f));
            const Grip now = handle(c, map, id, from, hovered, color);
            if (now == Grip::kHeld || now == Grip::kLetGo) {
                n[0] = static_cast<float>(std::atan2(static_cast<double>(middle.y - from.y),
                                                     static_cast<double>(from.x - middle.x)) /
                                          kDegree);
                grip = now;
            }
            taken = now == Grip::kTaken;
        }
        if (taken) c.state.lamp = static_cast<int>(k);
        if (lamps[k].kind == LampKind::kPoint)
            tag(c, map.to_screen({n[0], n[1]}), ("Lamp " + std::to_string(k + 1)).c_str());
        if (grip != Grip::kNone) set_lamp(c, *region, k, n, grip == Grip::kLetGo);
    }
}

}  // namespace weft::ui

// Inspector rows: a label, a control, and a dot if the value is not the default.
#include "ui/widgets/widgets.h"

#include <imgui_internal.h>  // giving up the active item
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/base/icons.h"

namespace weft::ui {

namespace {

struct Row {
    ImVec2 control;  // top left of the control
    float width = 0;
};

// Draws the label and leaves the cursor at the control.
Row begin_row(Ctx& c, const char* label, const char* tip, float reserve_right) {
    const Theme& t = c.theme;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float avail = ImGui::GetContentRegionAvail().x;
    const float label_w = std::floor(avail * 0.38f);
    ImGui::InvisibleButton((std::string("##label") + label).c_str(), {label_w, t.row});
    if (tip && *tip) tooltip(c, tip);
    // A long label is set smaller before it is shortened.
    const std::string text = visible(label);
    const bool fits = ImGui::CalcTextSize(text.c_str()).x <= label_w - t.px(6);
    ImFont* const font = fits ? t.regular : t.small;
    ImGui::PushFont(font);
    const std::string shown = fitted(text, label_w - t.px(6));
    ImGui::PopFont();
    text_in(*ImGui::GetWindowDrawList(), font, at, {at.x + label_w, at.y + t.row}, t.quiet,
            shown.c_str(), 0);
    ImGui::SameLine(0, 0);
    return {{at.x + label_w, at.y}, avail - label_w - reserve_right};
}

// The dot of a changed value; a click resets it.
bool reset_dot(Ctx& c, const char* label, bool differs) {
    const Theme& t = c.theme;
    ImGui::SameLine(0, 0);
    ImGui::PushID(label);
    const bool pressed = ImGui::InvisibleButton("##reset", {t.px(16), t.row}) && differs;
    ImGui::PopID();
    if (!differs) return false;
    c.note(std::string("Reset ") + visible(label));
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    const bool hovered = ImGui::IsItemHovered();
    ImGui::GetWindowDrawList()->AddCircleFilled(
        {(min.x + max.x) * 0.5f + t.px(2), (min.y + max.y) * 0.5f}, t.px(hovered ? 4 : 3),
        hovered ? t.accent_hover : t.accent, 12);
    tooltip(c, "Changed. Click to reset to the default");
    return pressed;
}

double to_unit(const SliderSpec& s, double v) {
    if (s.logarithmic) return std::log(std::max(v, 1e-9) / s.min) / std::log(s.max / s.min);
    return (v - s.min) / (s.max - s.min);
}

double from_unit(const SliderSpec& s, double u) {
    const double v =
        s.logarithmic ? s.min * std::pow(s.max / s.min, u) : s.min + u * (s.max - s.min);
    const double step = s.integer ? 1.0 : std::pow(10.0, -s.decimals);
    return std::clamp(std::round(v / step) * step, s.min, s.max);
}

// Of the last item drawn. `active`: the mouse has it.
Change drag_slider(Ctx& c, const SliderSpec& s, double& value, bool active, float width) {
    if (ImGui::IsItemActivated()) {
        c.state.drag_start = value;
        c.state.drag_moved = false;
    }
    if (active && ImGui::IsKeyPressed(256)) {
        // As it was before the drag.
        ImGui::ClearActiveID();
        if (std::exchange(c.state.drag_moved, false)) c.drop_tried();
        return Change::kNone;
    }
    if (active && ImGui::IsMouseDragging(0, c.theme.px(3))) {
        // Relative to the start, so that a click alone changes nothing. Shift: a tenth of the
        // speed.
        const double fine = ImGui::GetIO().KeyShift ? 0.1 : 1.0;
        const double moved = fine * static_cast<double>(ImGui::GetMouseDragDelta(0, 0).x / width);
        value = from_unit(s, std::clamp(to_unit(s, c.state.drag_start) + moved, 0.0, 1.0));
        c.state.drag_value = value;
        c.state.drag_moved = true;
        return Change::kTrying;
    }
    if (!ImGui::IsItemDeactivated() || !c.state.drag_moved || !s.enabled) return Change::kNone;
    value = c.state.drag_value;
    c.state.drag_moved = false;
    return Change::kDone;
}

}  // namespace

Change slider(Ctx& c, const SliderSpec& s, double& value) {
    const Theme& t = c.theme;
    ImGui::PushID(s.label);
    const Row row = begin_row(c, s.label, s.tip, t.px(16));
    Change change = Change::kNone;
    const std::string name = c.panel + "/" + visible(s.label);
    const std::string shown = number_text(value, s.integer ? 0 : s.decimals) +
                              (s.unit[0] ? std::string(" ") + s.unit : "");
    if (c.state.typing == name) {
        ImGui::SetNextItemWidth(row.width);
        if (!ImGui::IsAnyItemActive()) ImGui::SetKeyboardFocusHere();
        const bool done = ImGui::InputText(
            "##typed", &c.state.typing_text,
            ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_EnterReturnsTrue);
        c.note(visible(s.label));
        if (done || (ImGui::IsMouseClicked(0) && !ImGui::IsItemHovered())) {
            char* end = nullptr;
            const double typed = std::strtod(c.state.typing_text.c_str(), &end);
            if (end != c.state.typing_text.c_str() && std::isfinite(typed)) {
                const bool own = s.typed_min <= s.typed_max;
                value = std::clamp(typed, own ? s.typed_min : s.min, own ? s.typed_max : s.max);
                if (s.integer) value = std::round(value);
                change = Change::kDone;
            }
            c.state.typing.clear();
        } else if (ImGui::IsKeyPressed(256)) {
            c.state.typing.clear();
        }
    } else {
        ImGui::InvisibleButton("##slider", {std::max(row.width, t.px(20)), t.row});
        c.note(visible(s.label), s.enabled);
        const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
        const bool hovered = ImGui::IsItemHovered() && s.enabled;
        const bool active = ImGui::IsItemActive() && s.enabled;
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddRectFilled(min, max, t.field, t.radius);
        const auto x_of = [&](double v) {
            const double u = std::clamp(to_unit(s, v), 0.0, 1.0);
            return min.x + static_cast<float>(u) * (max.x - min.x);
        };
        if (s.enabled) {
            const float from = x_of(s.standard), to = x_of(value);
            list.AddRectFilled({std::min(from, to), min.y}, {std::max(from, to), max.y},
                               faded(t.accent, active || hovered ? 0.42f : 0.32f), t.radius);
            list.AddRectFilled({std::clamp(to - t.px(1), min.x, max.x - t.px(2)), min.y},
                               {std::clamp(to + t.px(1), min.x + t.px(2), max.x), max.y},
                               active ? t.accent_hover : t.accent);
        }
        if (hovered || active) list.AddRect(min, max, faded(t.accent, 0.6f), t.radius);
        text_in(list, t.regular, {min.x + t.px(8), min.y}, max, s.enabled ? t.text : t.off,
                shown.c_str(), 0);
        change = drag_slider(c, s, value, active, max.x - min.x);
        if (hovered && ImGui::IsMouseDoubleClicked(0)) {
            c.state.typing = name;
            c.state.typing_text = number_text(value, s.integer ? 0 : s.decimals);
        }
        if (hovered && !active && s.tip[0]) tooltip(c, s.tip);
    }
    const double step = s.integer ? 0.5 : 0.5 * std::pow(10.0, -s.decimals);
    if (reset_dot(c, s.label, std::abs(value - s.standard) > step) && s.enabled) {
        value = s.standard;
        change = Change::kDone;
    }
    ImGui::PopID();
    return change;
}

bool choice(Ctx& c, const char* label, const std::vector<std::string>& names, int& value,
            const char* tip, int standard) {
    const Theme& t = c.theme;
    ImGui::PushID(label);
    const Row row = begin_row(c, label, tip, t.px(16));
    bool changed = false;
    const std::string now = value >= 0 && value < static_cast<int>(names.size())
                                ? names[static_cast<std::size_t>(value)]
                                : "";
    ImGui::InvisibleButton("##choice", {row.width, t.row});
    const bool pressed = ImGui::IsItemClicked();
    c.note(visible(label));
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(min, max, t.field, t.radius);
    if (ImGui::IsItemHovered()) list.AddRectFilled(min, max, t.hover, t.radius);
    text_in(list, t.regular, {min.x + t.px(8), min.y}, {max.x - t.px(22), max.y}, t.text,
            fitted(now, row.width - t.px(34)).c_str(), 0);
    icon_in(c, list, {max.x - t.px(24), min.y}, max, t.quiet, icons::kMenuDown);
    if (tip) tooltip(c, tip);
    if (pressed) ImGui::OpenPopup("##choices");
    ImGui::SetNextWindowPos({min.x, max.y + t.px(2)});
    ImGui::SetNextWindowSizeConstraints({row.width, 0}, {FLT_MAX, t.px(400)});
    if (ImGui::BeginPopup("##choices")) {
        const PanelName menu(c, "Choices");
        for (std::size_t k = 0; k < names.size(); ++k) {
            if (ImGui::Selectable(names[k].c_str(), static_cast<int>(k) == value)) {
                changed = static_cast<int>(k) != value;
                value = static_cast<int>(k);
            }
            c.note(names[k]);
        }
        ImGui::EndPopup();
    }
    if (reset_dot(c, label, standard >= 0 && value != standard)) {
        value = standard;
        changed = true;
    }
    ImGui::PopID();
    return changed;
}

bool input(Ctx& c, const char* name, std::string& value, const char* hint, float width,
           const char* icon) {
    const Theme& t = c.theme;
    if (width < 0) width = ImGui::GetContentRegionAvail().x;
    ImGui::PushID(name);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float pad = icon ? t.px(28) : t.px(8);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {pad, ImGui::GetStyle().FramePadding.y});
    ImGui::SetNextItemWidth(width);
    const bool changed = ImGui::InputTextWithHint("##input", hint, &value);
    ImGui::PopStyleVar();
    const float room = width - pad - t.px(8);
    if (!ImGui::IsItemActive() && ImGui::CalcTextSize(value.c_str()).x > room) {
        // Too long: shorten in the middle, because both ends are informative.
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
        list.AddRectFilled(min, max, t.field, t.radius);
        text_in(list, t.regular, {min.x + pad, min.y}, max, t.text,
                fitted(value, room, true).c_str(), 0);
    }
    c.note(name);
    if (ImGui::IsItemActive())
        ImGui::GetWindowDrawList()->AddRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(),
                                            t.accent, t.radius);
    if (icon)
        icon_in(c, *ImGui::GetWindowDrawList(), at, {at.x + t.px(28), at.y + t.row}, t.quiet, icon);
    ImGui::PopID();
    return changed;
}

Change text_row(Ctx& c, const char* label, std::string& value, const char* hint, const char* tip) {
    ImGui::PushID(label);
    const Row row = begin_row(c, label, tip, c.theme.px(16));
    // Typed text is kept here until it is finished, so that the document changes once.
    const std::string name = c.panel + "/" + visible(label);
    const bool typing = c.state.typing == name;
    std::string& text = typing ? c.state.typing_text : value;
    input(c, label, text, hint, row.width);
    Change change = Change::kNone;
    if (ImGui::IsItemActivated()) {
        c.state.typing_text = value;
        c.state.typing = name;
    }
    if (typing && ImGui::IsItemDeactivated()) {
        if (ImGui::IsItemDeactivatedAfterEdit() && c.state.typing_text != value) {
            value = c.state.typing_text;
            change = Change::kDone;
        }
        c.state.typing.clear();
    }
    ImGui::PopID();
    return change;
}

void info_row(Ctx& c, const char* label, const std::string& value, const char* tip) {
    ImGui::PushID(label);
    const Theme& t = c.theme;
    const Row row = begin_row(c, label, tip, t.px(8));
    ImGui::InvisibleButton("##info", {row.width, t.row});
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    const std::string shown = fitted(value, row.width - t.px(8), true);
    text_in(*ImGui::GetWindowDrawList(), t.regular, {min.x + t.px(8), min.y}, max, t.text,
            shown.c_str(), 0);
    if (shown != value) tooltip(c, value.c_str());
    ImGui::PopID();
}

// ---- structure -------------------------------------------------------------------------------

bool section(Ctx& c, const char* title, bool open_at_first) {
    const Theme& t = c.theme;
    ImGui::PushID(title);
    const ImGuiID id = ImGui::GetID("##open");
    ImGuiStorage* storage = ImGui::GetStateStorage();
    PointedSetting& pointed = c.state.pointed;
    pointed.in_section = title;
    pointed.in_section_id = id;
    if (pointed.found_in == id) {
        storage->SetBool(id, true);
        pointed.found_in = 0;
    }
    // What is looked for may be in any of them.
    const bool looking = !pointed.name.empty() && !pointed.found;
    bool open = storage->GetBool(id, open_at_first) || looking;
    const float width = ImGui::GetContentRegionAvail().x;
    if (ImGui::InvisibleButton("##section", {width, t.px(30)})) {
        open = !open;
        storage->SetBool(id, open);
    }
    c.note(title);
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine({min.x - t.pad, min.y}, {max.x + t.pad, min.y}, t.line);
    if (ImGui::IsItemHovered())
        list.AddRectFilled({min.x - t.pad, min.y}, {max.x + t.pad, max.y}, t.hover);
    icon_in(c, list, {min.x - t.px(4), min.y}, {min.x + t.px(14), max.y}, t.quiet,
            open ? icons::kChevronDown : icons::kChevronRight);
    text_in(list, t.strong, {min.x + t.px(20), min.y}, max, t.text, title, 0);
    ImGui::PopID();
    return open;
}

void section_gap(Ctx& c) {
    ImGui::Dummy({0, c.theme.px(6)});
}

void no_region(Ctx& c) {
    empty_state(c, icons::kLayers, "No region selected",
                c.view.project.regions.empty() && c.state.workspace == Workspace::kMask
                    ? "A region is a surface that gets a new texture. Paint over one on the "
                      "picture."
                    : "A region is a surface that gets a new texture. Add one above, then paint "
                      "its matte.");
}

}  // namespace weft::ui

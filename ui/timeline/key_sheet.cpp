// The dope sheet: a row for everything that has keys.
#include <algorithm>
#include <cmath>
#include <optional>

#include "ui/timeline/key_parts.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

constexpr float kRow = 22;      // unscaled
constexpr float kKeyReach = 7;  // from the mouse to a key that is pressed

struct Sheet {
    const std::vector<KeyRow>& rows;
    FrameScale scale;
    float top, row_h;
    [[nodiscard]] float y_of(std::size_t row) const {
        return top + (static_cast<float>(row) + 0.5f) * row_h;
    }
};

std::optional<KeyRef> key_at(const Ctx& c, const Sheet& sheet, ImVec2 p) {
    const float row = std::floor((p.y - sheet.top) / sheet.row_h);
    if (row < 0 || row >= static_cast<float>(sheet.rows.size())) return std::nullopt;
    const KeyRow& here = sheet.rows[static_cast<std::size_t>(row)];
    std::optional<KeyRef> best;
    float nearest = c.theme.px(kKeyReach);
    for (const KeyMark& key : here.keys) {
        const float apart = std::abs(sheet.scale.x_of(key.frame) - p.x);
        if (apart > nearest) continue;
        nearest = apart;
        best = KeyRef{here.id, key.frame};
    }
    return best;
}

void go_on(Ctx& c, const Sheet& sheet) {
    KeysState& s = c.state.keys;
    const float moved = ImGui::GetIO().MousePos.x - s.from.x;
    if (s.drag == KeysState::Drag::kBox) {
        if (ImGui::IsMouseDown(0)) return draw_box(c, *ImGui::GetWindowDrawList());
        const ScreenBox box = drag_box(c);
        KeySet inside;
        for (std::size_t k = 0; k < sheet.rows.size(); ++k)
            for (const KeyMark& key : sheet.rows[k].keys)
                if (box.holds({sheet.scale.x_of(key.frame), sheet.y_of(k)}))
                    inside.insert({sheet.rows[k].id, key.frame});
        return end_box(c, inside);
    }
    const int by = allowed_move(c, s.selected,
                                static_cast<int>(std::lround(moved / sheet.scale.frame_width())));
    if (ImGui::IsMouseDown(0)) {
        if (by != s.by) try_region(c, *s.before, with_keys_moved(*s.before, s.selected, by));
        s.by = by;
        return;
    }
    end_key_drag(c);
}

void draw_names(Ctx& c, ImDrawList& list, const Sheet& sheet, float left, float right) {
    const Theme& t = c.theme;
    for (std::size_t k = 0; k < sheet.rows.size(); ++k) {
        const float y = sheet.y_of(k) - sheet.row_h / 2;
        const std::string name = fitted(row_name(sheet.rows[k].id), right - left - t.px(20));
        text_in(list, t.regular, {left + t.px(12), y}, {right, y + sheet.row_h}, t.text,
                name.c_str(), 0);
    }
}

void draw_rows(Ctx& c, ImDrawList& list, const Sheet& sheet, float left, float right) {
    const Theme& t = c.theme;
    const KeysState& s = c.state.keys;
    const float r = t.px(kKeyRadius);
    for (std::size_t k = 0; k < sheet.rows.size(); ++k) {
        const KeyRow& row = sheet.rows[k];
        const float y = sheet.y_of(k);
        list.AddLine({left, y + sheet.row_h / 2}, {right, y + sheet.row_h / 2}, t.line);
        list.AddLine({sheet.scale.x_of(row.keys.front().frame), y},
                     {sheet.scale.x_of(row.keys.back().frame), y}, t.off);
        for (const KeyMark& key : row.keys) {
            const ImVec2 at(std::floor(sheet.scale.x_of(key.frame)) + 0.5f, std::floor(y) + 0.5f);
            const KeyRef ref{row.id, key.frame - (s.drag == KeysState::Drag::kKeys ? s.by : 0)};
            const bool selected = s.selected.contains(ref);
            const ImU32 color = selected                                ? t.accent_hover
                                : row.id.kind == KeyRowKind::kReference ? t.warn
                                                                        : t.text;
            if (row.id.kind == KeyRowKind::kReference)
                list.AddTriangleFilled({at.x, at.y - r}, {at.x + r, at.y + r}, {at.x - r, at.y + r},
                                       color);
            else
                key_glyph(list, at, key.between ? r * 0.6f : r, key.after, color,
                          selected ? t.text : t.line);
            c.note(row_name(row.id) + " " + std::to_string(key.frame), {at.x - r, at.y - r},
                   {at.x + r, at.y + r});
        }
    }
}

}  // namespace

void key_sheet(Ctx& c, const Region& region, const std::vector<KeyRow>& rows, ImVec2 min,
               ImVec2 max) {
    const Theme& t = c.theme;
    KeysState& s = c.state.keys;
    const float left = min.x + key_names_width(c), row_h = t.px(kRow);
    const float all_h = row_h * static_cast<float>(rows.size());
    s.scroll_y = std::clamp(s.scroll_y, 0.0f, std::max(0.0f, all_h - (max.y - min.y)));
    const Sheet sheet{rows, frame_scale(c, left, max.x), min.y - s.scroll_y, row_h};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({left, min.y}, max, t.field);
    list.PushClipRect(min, max, true);
    draw_names(c, list, sheet, min.x, left);
    list.PushClipRect({left, min.y}, max, true);
    const float x = std::floor(sheet.scale.x_of(c.view.frame)) + 0.5f;
    list.AddLine({x, min.y}, {x, max.y}, faded(t.text, 0.6f));
    draw_rows(c, list, sheet, left, max.x);
    ImGui::SetCursorScreenPos({left, min.y});
    ImGui::InvisibleButton("##rows", {std::max(1.0f, max.x - left), std::max(1.0f, max.y - min.y)},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (ImGui::IsItemHovered()) {
        const auto key = key_at(c, sheet, mouse);
        if (key) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
        if (ImGui::IsMouseClicked(0)) {
            if (key)
                press_key(c, region, *key, 0);
            else
                press_beside(c);
        } else if (ImGui::IsMouseClicked(1)) {
            open_key_menu(c, key);
        }
        if (ImGui::IsMouseDoubleClicked(0) && key) c.emit(GoToFrame{key->frame});
        if (ImGui::GetIO().MouseWheel != 0 && !ImGui::GetIO().KeyCtrl)
            s.scroll_y -= ImGui::GetIO().MouseWheel * row_h;
    }
    if (s.drag == KeysState::Drag::kKeys || s.drag == KeysState::Drag::kBox) go_on(c, sheet);
    // What is above and below.
    if (all_h > max.y - min.y) {
        const float part = (max.y - min.y) / all_h, from = min.y + s.scroll_y * part;
        list.AddRectFilled({max.x - t.px(4), from}, {max.x, from + (max.y - min.y) * part},
                           faded(t.quiet, 0.6f), t.px(2));
    }
    list.PopClipRect();
    list.PopClipRect();
}

}  // namespace weft::ui

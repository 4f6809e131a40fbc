#include "ui/timeline/key_parts.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

constexpr float kNames = 172;  // unscaled width of the names' column

// A row whose keys lie on frames of the plate.
bool needs_frames(const KeyRowId& row) {
    return row.kind != KeyRowKind::kNumbers && row.kind != KeyRowKind::kLamp &&
           row.kind != KeyRowKind::kZoneValue && row.kind != KeyRowKind::kMatteEdge &&
           row.kind != KeyRowKind::kWarp;
}

std::string layer_text(int layer) {
    if (layer == 0) return "Matte";
    return layer > 0 ? "Holdout " + std::to_string(layer) : "Zone " + std::to_string(-layer);
}

const char* numbers_name(const std::string& key) {
    constexpr std::pair<std::string_view, const char*> kNamesOf[] = {
        {"placement.scale_keys", "Texture scale"},   {"placement.rotate_keys", "Texture rotation"},
        {"placement.offset_keys", "Texture offset"}, {"form.amount_keys", "Form amount"},
        {"light.strength_keys", "Light strength"},   {"matte.choke_keys", "choke"},
        {"matte.feather_keys", "feather"},           {"matte.blur_keys", "blur"}};
    for (const auto& [known, name] : kNamesOf)
        if (known == key) return name;
    return "";
}

}  // namespace

float key_names_width(const Ctx& c) {
    return c.state.keys.open ? c.theme.px(kNames) : 0.0f;
}

FrameScale frame_scale(const Ctx& c, float left, float right) {
    const std::vector<int>& frames = c.view.plate.frames;
    FrameScale out{left, right, static_cast<double>(frames.front()),
                   static_cast<double>(frames.back())};
    if (c.state.keys.open && c.state.keys.frames)
        std::tie(out.first, out.last) = *c.state.keys.frames;
    // Half a bar extends beyond the first and the last frame.
    const auto count = static_cast<float>(out.last - out.first + 1);
    const float inset = std::max(c.theme.px(16), (right - left) * 0.5f / count);
    out.x0 = left + inset;
    out.x1 = right - inset;
    return out;
}

std::string row_name(const KeyRowId& row) {
    switch (row.kind) {
        case KeyRowKind::kMatte:
            return layer_text(row.layer) + (row.layer < 0 ? " matte" : "");
        case KeyRowKind::kShape:
            return layer_text(row.layer) + " shape";
        case KeyRowKind::kReference:
            return "Reference frames";
        case KeyRowKind::kCorrection:
            return "Corrections";
        case KeyRowKind::kLamp:
            return "Lamp " + std::to_string(row.layer + 1);
        case KeyRowKind::kZoneValue:
            return "Zone " + std::to_string(row.layer + 1) + " value";
        case KeyRowKind::kMatteEdge:
            return layer_text(row.layer) + " " + numbers_name(row.key);
        case KeyRowKind::kWarp:
            return "Grid warp";
        case KeyRowKind::kNumbers:
            break;
    }
    return numbers_name(row.key);
}

std::vector<KeyCurve> key_curves(const Region& region, const std::vector<KeyRow>& rows) {
    std::vector<KeyCurve> out;
    for (const KeyRow& row : rows) {
        const KeyedNumbers* numbers = numbers_of(region, row.id);
        if (!numbers) continue;
        const std::size_t count = numbers->keys[0].numbers.size();
        for (std::size_t k = 0; k < count; ++k) {
            std::string name = row_name(row.id);
            if (count == 2) name += k == 0 ? " x" : " y";
            if (count > 2) name += " " + std::to_string(k + 1);
            out.push_back({row.id, k, region_color(static_cast<int>(out.size())), std::move(name)});
        }
    }
    return out;
}

bool is_curve_shown(const Ctx& c, const KeyRowId& row) {
    const auto& shown = c.state.keys.curves;
    return shown.empty() || shown.contains(row);
}

void key_glyph(ImDrawList& list, ImVec2 at, float radius, KeyInterpolation after, ImU32 color,
               ImU32 edge) {
    const float r = radius;
    if (after == KeyInterpolation::kSmooth) {
        list.AddCircleFilled(at, r * 0.92f, color, 16);
        list.AddCircle(at, r * 0.92f, edge, 16);
    } else if (after == KeyInterpolation::kHold) {
        const float h = r * 0.82f;
        list.AddRectFilled({at.x - h, at.y - h}, {at.x + h, at.y + h}, color);
        list.AddRect({at.x - h, at.y - h}, {at.x + h, at.y + h}, edge);
    } else {
        list.AddQuadFilled({at.x, at.y - r}, {at.x + r, at.y}, {at.x, at.y + r}, {at.x - r, at.y},
                           color);
        list.AddQuad({at.x, at.y - r}, {at.x + r, at.y}, {at.x, at.y + r}, {at.x - r, at.y}, edge);
    }
}

int allowed_move(const Ctx& c, const KeySet& keys, int by) {
    const std::vector<int>& frames = c.view.plate.frames;
    const auto fits = [&](int step) {
        return std::all_of(keys.begin(), keys.end(), [&](const KeyRef& key) {
            const int to = key.frame + step;
            if (needs_frames(key.row)) return std::binary_search(frames.begin(), frames.end(), to);
            // A key that lies beyond the shot may move, but none moves out of it.
            return (to >= frames.front() || to >= key.frame) &&
                   (to <= frames.back() || to <= key.frame);
        });
    };
    while (by != 0 && !fits(by))
        by -= by > 0 ? 1 : -1;
    return by;
}

void try_region(Ctx& c, const Region& before, const Region& after) {
    c.emit(TryEdits{region_edits(before, after)});
}

void keep_region(Ctx& c, const Region& before, const Region& after, const std::string& label) {
    std::vector<Edit> edits = region_edits(before, after);
    if (edits.empty())
        c.drop_tried();
    else
        c.emit(DoEdits{std::move(edits), label});
}

void press_key(Ctx& c, const Region& region, const KeyRef& key, std::size_t which) {
    KeysState& s = c.state.keys;
    s.adds = ImGui::GetIO().KeyShift;
    s.was_selected = s.selected.contains(key);
    if (!s.was_selected && !s.adds) s.selected.clear();
    s.selected.insert(key);
    s.active = key;
    s.active_number = which;
    s.drag = KeysState::Drag::kKeys;
    s.from = ImGui::GetIO().MousePos;
    s.before = region;
    s.by = 0;
    s.by_value = 0;
}

void end_key_drag(Ctx& c) {
    KeysState& s = c.state.keys;
    s.drag = KeysState::Drag::kNone;
    if (s.by != 0 || s.by_value != 0) {
        keep_region(c, *s.before, dragged_region(c), "Move keys");
        KeySet moved;
        for (const KeyRef& key : s.selected)
            moved.insert({key.row, key.frame + s.by});
        s.selected = std::move(moved);
        if (s.active) s.active->frame += s.by;
    } else if (s.adds && s.was_selected) {
        s.selected.erase(*s.active);
        s.active.reset();
    } else if (!s.adds) {
        s.selected = {*s.active};
    }
    s.by = 0;
    s.by_value = 0;
    s.before.reset();
}

void press_beside(Ctx& c) {
    KeysState& s = c.state.keys;
    s.adds = ImGui::GetIO().KeyShift;
    if (!s.adds) {
        s.selected.clear();
        s.active.reset();
    }
    s.drag = KeysState::Drag::kBox;
    s.from = ImGui::GetIO().MousePos;
}

void end_box(Ctx& c, const KeySet& inside) {
    KeysState& s = c.state.keys;
    s.drag = KeysState::Drag::kNone;
    s.selected.insert(inside.begin(), inside.end());
    if (!inside.empty()) s.active = *inside.begin();
    s.active_number = 0;
}

ScreenBox drag_box(const Ctx& c) {
    const ImVec2 a = c.state.keys.from, b = ImGui::GetIO().MousePos;
    return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}

void draw_box(Ctx& c, ImDrawList& list) {
    const ScreenBox box = drag_box(c);
    list.AddRectFilled(box.min, box.max, faded(c.theme.accent, 0.15f));
    list.AddRect(box.min, box.max, c.theme.accent_hover);
}

void set_interpolation(Ctx& c, const Region& region, KeyInterpolation after) {
    keep_region(c, region, with_interpolation(region, c.state.keys.selected, after),
                "Interpolate keys: " + std::string(name_of(after)));
}

void copy_keys(Ctx& c, const Region& region) {
    c.state.keys.copied = copied_keys(region, c.state.keys.selected);
}

void paste_keys(Ctx& c, const Region& region) {
    PastedKeys pasted = with_keys_pasted(region, c.state.keys.copied, c.view.frame);
    if (pasted.keys.empty()) return;
    keep_region(c, region, pasted.region, "Paste keys");
    c.state.keys.active = *pasted.keys.begin();
    c.state.keys.active_number = 0;
    c.state.keys.selected = std::move(pasted.keys);
}

void delete_keys(Ctx& c, const Region& region) {
    keep_region(c, region, without_keys(region, c.state.keys.selected), "Delete keys");
    c.state.keys.selected.clear();
    c.state.keys.active.reset();
}

void open_key_menu(Ctx& c, const std::optional<KeyRef>& key) {
    KeysState& s = c.state.keys;
    if (key && !s.selected.contains(*key)) s.selected = {*key};
    if (key) s.active = key;
    if (key) s.active_number = 0;
    s.menu_asked = true;
}

void key_menu(Ctx& c, const Region& region) {
    const Theme& t = c.theme;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {t.px(6), t.px(6)});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {t.px(8), t.px(6)});
    if (std::exchange(c.state.keys.menu_asked, false)) ImGui::OpenPopup("##key menu");
    if (ImGui::BeginPopup("##key menu")) {
        const PanelName within(c, "Key menu");
        KeysState& s = c.state.keys;
        const auto item = [&](const char* name, const char* key, bool enabled) {
            const bool pressed = ImGui::MenuItem(name, key, false, enabled);
            c.note(name, enabled);
            return pressed;
        };
        const bool numbers =
            std::any_of(s.selected.begin(), s.selected.end(),
                        [&](const KeyRef& key) { return numbers_of(region, key.row) != nullptr; });
        if (item("Linear", "", numbers)) set_interpolation(c, region, KeyInterpolation::kLinear);
        if (item("Smooth", "", numbers)) set_interpolation(c, region, KeyInterpolation::kSmooth);
        if (item("Hold", "", numbers)) set_interpolation(c, region, KeyInterpolation::kHold);
        ImGui::Separator();
        if (item("Copy", "Ctrl+C", !s.selected.empty())) copy_keys(c, region);
        if (item("Paste at the playhead", "Ctrl+V", !s.copied.empty())) paste_keys(c, region);
        if (item("Delete", "Delete", !s.selected.empty())) delete_keys(c, region);
        if (s.active) {
            ImGui::Separator();
            if (item("Go to this frame", "", true)) c.emit(GoToFrame{s.active->frame});
        }
        ImGui::EndPopup();
    }
    ImGui::PopStyleVar(2);
}

void fit_keys(Ctx& c) {
    c.state.keys.frames.reset();
    c.state.keys.values.reset();
}

}  // namespace weft::ui

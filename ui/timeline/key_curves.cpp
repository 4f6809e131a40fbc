// The curve editor: keyed numbers over time, as they are evaluated.
#include <algorithm>
#include <cmath>
#include <optional>

#include "ui/timeline/key_parts.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

constexpr float kCurveReach = 8;  // from the mouse to a key that is pressed
constexpr float kNameRow = 22;    // of the list of curves

struct Plot {
    std::vector<KeyCurve> curves;  // those that are shown
    const Region& region;
    FrameScale scale;
    ImVec2 min, max;
    double low, high;  // the values at its lower and upper edge
    [[nodiscard]] float y_of(double value) const {
        return max.y - static_cast<float>((value - low) / (high - low)) * (max.y - min.y);
    }
    [[nodiscard]] double value_per_px() const {
        return (high - low) / static_cast<double>(std::max(1.0f, max.y - min.y));
    }
    [[nodiscard]] const KeyedNumbers& numbers(const KeyCurve& curve) const {
        return *numbers_of(region, curve.row);
    }
};

// The values of all shown keys with room around them.
std::pair<double, double> fitted_values(const Region& region, const std::vector<KeyCurve>& curves) {
    double low = 1e30, high = -1e30;
    for (const KeyCurve& curve : curves) {
        for (const NumberKey& key : numbers_of(region, curve.row)->keys) {
            low = std::min(low, key.numbers[curve.which]);
            high = std::max(high, key.numbers[curve.which]);
        }
    }
    if (low > high) return {0, 1};
    const double room = high > low ? 0.15 * (high - low) : std::max(0.5, 0.2 * std::abs(low));
    return {low - room, high + room};
}

// 1, 2 or 5 times a power of ten: of the steps of the grid.
double nice_value(double least) {
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= least) return factor * power;
    return 10 * power;
}

void draw_grid(Ctx& c, ImDrawList& list, const Plot& plot) {
    const Theme& t = c.theme;
    const double step = nice_value(static_cast<double>(t.px(28)) * plot.value_per_px());
    const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
    const double first = std::ceil(plot.low / step);
    for (int k = 0; k < 200 && (first + k) * step <= plot.high; ++k) {
        const double value = (first + k) * step;
        const float y = std::floor(plot.y_of(value)) + 0.5f;
        list.AddLine({plot.min.x, y}, {plot.max.x, y},
                     std::abs(value) < step / 2 ? t.off : faded(t.off, 0.35f));
        list.AddText(t.small, t.small->FontSize, {plot.min.x + t.px(4), y - t.px(14)}, t.quiet,
                     number_text(value == 0 ? 0 : value, decimals).c_str());
    }
}

void draw_curve(Ctx& c, ImDrawList& list, const Plot& plot, const KeyCurve& curve) {
    const KeyedNumbers& numbers = plot.numbers(curve);
    const int first = static_cast<int>(std::floor(plot.scale.at(plot.min.x)));
    const int last = static_cast<int>(std::ceil(plot.scale.at(plot.max.x)));
    // Not more points than pixels.
    const int step = std::max(1, static_cast<int>(1 / std::max(0.001f, plot.scale.frame_width())));
    std::vector<ImVec2> line;
    for (int f = first; f <= last + step; f += step) {
        const double value = numbers.at(f)[curve.which];
        const ImVec2 at(plot.scale.x_of(f), plot.y_of(value));
        // A value that is held goes to the next one in a step.
        const NumberKey* here = numbers.key(f);
        if (here && !line.empty() && here != &numbers.keys.front() &&
            (here - 1)->after == KeyInterpolation::kHold)
            line.push_back({at.x, line.back().y});
        line.push_back(at);
    }
    list.AddPolyline(line.data(), static_cast<int>(line.size()), curve.color, ImDrawFlags_None,
                     c.theme.px(1.6f));
}

void draw_keys(Ctx& c, ImDrawList& list, const Plot& plot, const KeyCurve& curve) {
    const Theme& t = c.theme;
    const KeysState& s = c.state.keys;
    const float r = t.px(kKeyRadius);
    for (const NumberKey& key : plot.numbers(curve).keys) {
        const ImVec2 at(plot.scale.x_of(key.frame), plot.y_of(key.numbers[curve.which]));
        const KeyRef ref{curve.row, key.frame - (s.drag == KeysState::Drag::kKeys ? s.by : 0)};
        const bool selected = s.selected.contains(ref);
        key_glyph(list, at, r, key.after, selected ? t.accent_hover : curve.color,
                  selected ? t.text : t.line);
        c.note(curve.name + " " + std::to_string(key.frame), {at.x - r, at.y - r},
               {at.x + r, at.y + r});
    }
}

struct Pressed {
    KeyRef key;
    std::size_t which;
};

std::optional<Pressed> curve_key_at(const Ctx& c, const Plot& plot, ImVec2 p) {
    std::optional<Pressed> best;
    float nearest = c.theme.px(kCurveReach);
    for (const KeyCurve& curve : plot.curves) {
        for (const NumberKey& key : plot.numbers(curve).keys) {
            const float apart = std::hypot(plot.scale.x_of(key.frame) - p.x,
                                           plot.y_of(key.numbers[curve.which]) - p.y);
            if (apart > nearest) continue;
            nearest = apart;
            best = Pressed{{curve.row, key.frame}, curve.which};
        }
    }
    return best;
}

// The keys moved in value, before they are moved in time. Of the row that was pressed the number
// that was pressed; of the others the first.
Region with_values_moved(const Region& before, const KeysState& s, double by) {
    Region out = before;
    for (const KeyRef& key : s.selected) {
        const KeyedNumbers* numbers = numbers_of(before, key.row);
        const NumberKey* there = numbers ? numbers->key(key.frame) : nullptr;
        const std::size_t which =
            s.active && s.active->row == key.row ? s.active_number : std::size_t{0};
        if (there && which < there->numbers.size())
            out = with_key_value(out, key, which, there->numbers[which] + by);
    }
    return out;
}

void go_on_in_curves(Ctx& c, const Plot& plot) {
    KeysState& s = c.state.keys;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (s.drag == KeysState::Drag::kBox) {
        if (ImGui::IsMouseDown(0)) return draw_box(c, *ImGui::GetWindowDrawList());
        const ScreenBox box = drag_box(c);
        KeySet inside;
        for (const KeyCurve& curve : plot.curves)
            for (const NumberKey& key : plot.numbers(curve).keys)
                if (box.holds({plot.scale.x_of(key.frame), plot.y_of(key.numbers[curve.which])}))
                    inside.insert({curve.row, key.frame});
        return end_box(c, inside);
    }
    float dx = mouse.x - s.from.x, dy = mouse.y - s.from.y;
    // Shift keeps to one direction; a press that hardly moves keeps the value.
    if (ImGui::GetIO().KeyShift) (std::abs(dx) > std::abs(dy) ? dy : dx) = 0;
    if (std::abs(dy) < c.theme.px(3) && s.by_value == 0) dy = 0;
    const int by =
        allowed_move(c, s.selected, static_cast<int>(std::lround(dx / plot.scale.frame_width())));
    const double by_value = -static_cast<double>(dy) * plot.value_per_px();
    if (!ImGui::IsMouseDown(0)) return end_key_drag(c);
    if (by == s.by && by_value == s.by_value) return;
    s.by = by;
    s.by_value = by_value;
    try_region(c, *s.before, dragged_region(c));
}

// The list of curves; a click shows one alone, with Shift it is added or left out.
void draw_curve_names(Ctx& c, ImDrawList& list, const std::vector<KeyCurve>& curves, ImVec2 min,
                      float right) {
    const Theme& t = c.theme;
    KeysState& s = c.state.keys;
    float y = min.y;
    for (const KeyCurve& curve : curves) {
        ImGui::SetCursorScreenPos({min.x, y});
        ImGui::PushID(curve.name.c_str());
        const bool pressed = ImGui::InvisibleButton("##curve", {right - min.x, t.px(kNameRow)});
        ImGui::PopID();
        c.note("Curve " + curve.name);
        const bool shown = is_curve_shown(c, curve.row);
        const ImVec2 a = ImGui::GetItemRectMin(), b = ImGui::GetItemRectMax();
        if (ImGui::IsItemHovered()) list.AddRectFilled(a, b, t.hover);
        const float mid = (a.y + b.y) / 2;
        list.AddRectFilled({a.x + t.px(12), mid - t.px(2)}, {a.x + t.px(26), mid + t.px(2)},
                           faded(curve.color, shown ? 1.0f : 0.3f), t.px(1));
        text_in(list, t.regular, {a.x + t.px(34), a.y}, b, shown ? t.text : t.off,
                fitted(curve.name, right - min.x - t.px(42)).c_str(), 0);
        tooltip(c, "Click to show only this curve, again for all; Shift adds or removes it");
        y += t.px(kNameRow);
        if (!pressed) continue;
        const bool alone = s.curves == std::set<KeyRowId>{curve.row};
        if (!ImGui::GetIO().KeyShift)
            s.curves = alone ? std::set<KeyRowId>{} : std::set<KeyRowId>{curve.row};
        else if (!s.curves.erase(curve.row))
            s.curves.insert(curve.row);
        s.values.reset();
    }
}

void zoom(Ctx& c, const Plot& plot) {
    KeysState& s = c.state.keys;
    const ImGuiIO& io = ImGui::GetIO();
    if (io.MouseWheel == 0 || io.KeyCtrl) return;
    const double by = std::pow(0.85, static_cast<double>(io.MouseWheel));
    const double at =
        plot.low + static_cast<double>(plot.max.y - io.MousePos.y) * plot.value_per_px();
    s.values = {at + by * (plot.low - at), at + by * (plot.high - at)};
}

}  // namespace

Region dragged_region(const Ctx& c) {
    const KeysState& s = c.state.keys;
    const Region changed =
        s.by_value == 0 ? *s.before : with_values_moved(*s.before, s, s.by_value);
    return with_keys_moved(changed, s.selected, s.by);
}

void key_curve_view(Ctx& c, const Region& region, const std::vector<KeyRow>& rows, ImVec2 min,
                    ImVec2 max) {
    const Theme& t = c.theme;
    KeysState& s = c.state.keys;
    const float left = min.x + key_names_width(c);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({left, min.y}, max, t.field);
    std::vector<KeyCurve> shown = key_curves(region, rows);
    list.PushClipRect(min, max, true);
    draw_curve_names(c, list, shown, min, left);
    list.PopClipRect();
    std::erase_if(shown, [&](const KeyCurve& curve) { return !is_curve_shown(c, curve.row); });
    if (shown.empty()) {
        text_in(list, t.regular, {left, min.y}, max, t.off,
                "No keyed numbers here. Key a value with the diamond beside its slider");
        return;
    }
    // Not fitted again during a drag, or the key would run away from the mouse.
    if (!s.values && s.drag == KeysState::Drag::kNone) s.values = fitted_values(region, shown);
    const auto [low, high] = s.values.value_or(std::pair(0.0, 1.0));
    const Plot plot{
        std::move(shown), region, frame_scale(c, left, max.x), {left, min.y}, max, low, high};
    list.PushClipRect(plot.min, plot.max, true);
    draw_grid(c, list, plot);
    const float x = std::floor(plot.scale.x_of(c.view.frame)) + 0.5f;
    list.AddLine({x, min.y}, {x, max.y}, faded(t.text, 0.6f));
    for (const KeyCurve& curve : plot.curves)
        draw_curve(c, list, plot, curve);
    for (const KeyCurve& curve : plot.curves)
        draw_keys(c, list, plot, curve);
    ImGui::SetCursorScreenPos(plot.min);
    ImGui::InvisibleButton("##plot", {std::max(1.0f, max.x - left), std::max(1.0f, max.y - min.y)},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    c.note("Plot");
    if (ImGui::IsItemHovered()) {
        const auto pressed = curve_key_at(c, plot, ImGui::GetIO().MousePos);
        if (pressed) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
        if (ImGui::IsMouseClicked(0)) {
            if (pressed)
                press_key(c, region, pressed->key, pressed->which);
            else
                press_beside(c);
        } else if (ImGui::IsMouseClicked(1)) {
            open_key_menu(c, pressed ? std::optional(pressed->key) : std::nullopt);
        }
        zoom(c, plot);
    }
    if (s.drag == KeysState::Drag::kKeys || s.drag == KeysState::Drag::kBox)
        go_on_in_curves(c, plot);
    list.PopClipRect();
}

}  // namespace weft::ui

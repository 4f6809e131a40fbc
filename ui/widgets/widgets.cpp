#include "ui/widgets/widgets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ui/base/icons.h"
#include "ui/widgets/wrap.h"

namespace weft::ui {
namespace {

// Draws a button's background by state; the caller draws its content.
void face(Ctx& c, ImVec2 min, ImVec2 max, Look look, bool enabled, bool hovered, bool held) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const Theme& t = c.theme;
    ImU32 fill = t.raised;
    if (look == Look::kPrimary) fill = held ? t.accent_press : hovered ? t.accent_hover : t.accent;
    if (look == Look::kDanger) fill = faded(t.bad, held ? 0.55f : 0.85f);
    if (look == Look::kQuiet) fill = 0;
    if (!enabled) fill = look == Look::kQuiet ? 0 : faded(t.raised, 0.55f);
    if (fill) list.AddRectFilled(min, max, fill, t.radius);
    if (enabled && hovered && look != Look::kPrimary)
        list.AddRectFilled(min, max, held ? faded(t.hover, 2.0f) : t.hover, t.radius);
}

ImU32 ink(const Ctx& c, Look look, bool enabled) {
    if (!enabled) return c.theme.off;
    return look == Look::kPrimary ? c.theme.on_accent : c.theme.text;
}

}  // namespace

std::string visible(const char* label) {
    const std::string text = label;
    return text.substr(0, text.find("##"));
}

std::string number_text(double value, int decimals) {
    char text[48];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text[0] == '-' && std::strtod(text, nullptr) == 0 ? text + 1 : text;
}

std::string percent_text(int done, int total) {
    return std::to_string(static_cast<int>(100.0 * done / total)) + "%";
}

std::string time_text(double seconds) {
    char text[48];
    const auto whole = static_cast<long long>(std::max(0.0, seconds) + 0.5);
    if (whole < 3600) {
        std::snprintf(text, sizeof text, "%lld:%02lld", whole / 60, whole % 60);
    } else {
        std::snprintf(text, sizeof text, "%lld h %02lld min", whole / 3600, whole / 60 % 60);
    }
    return text;
}

std::string bytes_text(double bytes) {
    const char* const units[] = {"B", "KB", "MB", "GB", "TB"};
    int k = 0;
    while (bytes >= 1000 && k < 4) {
        bytes /= 1000;
        ++k;
    }
    return number_text(bytes, bytes < 10 && k > 1 ? 1 : 0) + " " + units[k];
}

std::string fitted(const std::string& text, float width, bool middle) {
    if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
    static const std::string kDots = "…";
    std::size_t low = 0, high = text.size();
    const auto cut = [&](std::size_t keep) {
        const auto whole = [&](std::size_t at) {  // never inside a UTF-8 sequence
            while (at > 0 && at < text.size() && (text[at] & 0xC0) == 0x80)
                --at;
            return at;
        };
        if (!middle) return text.substr(0, whole(keep)) + kDots;
        const std::size_t front = whole(keep / 3), back = whole(text.size() - (keep - keep / 3));
        return text.substr(0, front) + kDots + text.substr(back);
    };
    while (low < high) {
        const std::size_t mid = (low + high + 1) / 2;
        if (ImGui::CalcTextSize(cut(mid).c_str()).x <= width)
            low = mid;
        else
            high = mid - 1;
    }
    return cut(low);
}

void text_in(ImDrawList& list, ImFont* font, ImVec2 min, ImVec2 max, ImU32 color, const char* text,
             float align_x) {
    const ImVec2 size = font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, text);
    const float x = std::floor(min.x + std::max(0.0f, max.x - min.x - size.x) * align_x);
    const float y = std::floor(min.y + (max.y - min.y - size.y) * 0.5f);
    list.AddText(font, font->FontSize, {x, y}, color, text);
}

void icon_in(Ctx& c, ImDrawList& list, ImVec2 min, ImVec2 max, ImU32 color, const char* icon) {
    ImFont* font = c.theme.regular;
    const auto code = [&] {
        const auto* u = reinterpret_cast<const unsigned char*>(icon);
        return static_cast<ImWchar>(((u[0] & 15) << 12) | ((u[1] & 63) << 6) | (u[2] & 63));
    }();
    if (!icon[0] || !icon[1] || !icon[2]) return;
    const ImFontGlyph* glyph = font->FindGlyphNoFallback(code);
    if (!glyph) return;
    const float w = glyph->X1 - glyph->X0, h = glyph->Y1 - glyph->Y0;
    const ImVec2 at(std::floor((min.x + max.x - w) * 0.5f - glyph->X0 + 0.5f),
                    std::floor((min.y + max.y - h) * 0.5f - glyph->Y0 + 0.5f));
    list.AddText(font, font->FontSize, at, color, icon);
}

void tooltip(Ctx& c, const char* text, const char* command) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    if (ImGui::IsMouseDown(0)) return;  // no tooltips during a drag
    const std::string key = command ? c.commands.key_of(command) : std::string();
    if ((!text || !*text) && key.empty()) return;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.theme.px(8), c.theme.px(5)});
    // Below the item so that its text stays visible; above it if there is no room.
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    const bool low = max.y + c.theme.px(90) > ImGui::GetIO().DisplaySize.y;
    const bool tall = max.y - min.y > c.theme.px(80);
    const float x = ImGui::GetIO().MousePos.x;
    const bool far_right = x > 0.75f * ImGui::GetIO().DisplaySize.x;
    if (!tall)
        ImGui::SetNextWindowPos({x, low ? min.y - c.theme.px(4) : max.y + c.theme.px(6)},
                                ImGuiCond_Always, {far_right ? 1.0f : 0.0f, low ? 1.0f : 0.0f});
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(c.theme.px(320));
    if (text && *text) ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    if (!key.empty()) {
        if (text && *text) ImGui::SameLine(0, c.theme.px(10));
        ImGui::PushStyleColor(ImGuiCol_Text, c.theme.quiet);
        ImGui::TextUnformatted(key.c_str());
        ImGui::PopStyleColor();
    }
    ImGui::EndTooltip();
    ImGui::PopStyleVar();
}

bool button(Ctx& c, const char* label, const ButtonOptions& o) {
    const Theme& t = c.theme;
    const std::string text = visible(label);
    const float icon_w = o.icon ? t.px(22) : 0;
    float width = o.width;
    if (width == 0) width = ImGui::CalcTextSize(text.c_str()).x + 2 * t.px(12) + icon_w;
    if (width < 0) width = std::max(t.row, ImGui::GetContentRegionAvail().x);
    const bool pressed = ImGui::InvisibleButton(label, {width, t.row}) && o.enabled;
    c.note(text, o.enabled);
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    face(c, min, max, o.look, o.enabled, ImGui::IsItemHovered(), ImGui::IsItemActive());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const std::string shown = fitted(text, width - icon_w - t.px(8));
    const float text_w = ImGui::CalcTextSize(shown.c_str()).x;
    const float left = min.x + std::max(t.px(4), (width - text_w - icon_w) * 0.5f);
    const ImU32 color = ink(c, o.look, o.enabled);
    if (o.icon) icon_in(c, list, {left - t.px(2), min.y}, {left + t.px(16), max.y}, color, o.icon);
    text_in(list, o.look == Look::kPrimary ? t.strong : t.regular, {left + icon_w, min.y},
            {max.x, max.y}, color, shown.c_str(), 0);
    tooltip(c, o.tip ? o.tip : (o.command ? "" : nullptr), o.command);
    return pressed;
}

bool icon_button(Ctx& c, const char* icon, const char* name, bool active, const char* command,
                 bool enabled, float side) {
    const Theme& t = c.theme;
    if (side == 0) side = t.icon_button;
    ImGui::PushID(name);
    const bool pressed = ImGui::InvisibleButton("##icon", {side, side}) && enabled;
    ImGui::PopID();
    c.note(name, enabled);
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (active) list.AddRectFilled(min, max, faded(t.accent, 0.30f), t.radius);
    if (enabled && ImGui::IsItemHovered()) list.AddRectFilled(min, max, t.hover, t.radius);
    icon_in(c, list, min, max,
            !enabled ? t.off
            : active ? t.accent_hover
                     : (ImGui::IsItemHovered() ? t.text : faded(t.text, 0.85f)),
            icon);
    tooltip(c, name, command);
    return pressed;
}

bool segments(Ctx& c, const char* name, const std::vector<const char*>& labels, int& value,
              float width) {
    const Theme& t = c.theme;
    if (width == 0) width = ImGui::GetContentRegionAvail().x;
    const float each = std::floor(width / static_cast<float>(labels.size()));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    list.AddRectFilled(at, {at.x + width, at.y + t.row}, t.field, t.radius);
    bool changed = false;
    ImGui::PushID(name);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, ImGui::GetStyle().ItemSpacing.y});
    for (std::size_t k = 0; k < labels.size(); ++k) {
        if (k) ImGui::SameLine();
        ImGui::PushID(static_cast<int>(k));
        // The last one fills the rest of the row.
        const float rest = k + 1 == labels.size() ? width - each * static_cast<float>(k) : each;
        const bool pressed = ImGui::InvisibleButton("##s", {rest, t.row});
        ImGui::PopID();
        c.note(labels[k]);
        const bool on = static_cast<int>(k) == value;
        const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
        const float in = t.px(2);
        if (on)
            list.AddRectFilled({min.x + in, min.y + in}, {max.x - in, max.y - in},
                               faded(t.accent, 0.32f), t.radius);
        else if (ImGui::IsItemHovered())
            list.AddRectFilled(min, max, t.hover, t.radius);
        text_in(list, t.regular, min, max, on ? t.text : t.quiet,
                fitted(labels[k], each - t.px(6)).c_str());
        if (pressed && !on) {
            value = static_cast<int>(k);
            changed = true;
        }
    }
    ImGui::PopStyleVar();
    ImGui::PopID();
    return changed;
}

bool checkbox(Ctx& c, const char* label, bool& value, const char* tip) {
    const Theme& t = c.theme;
    const std::string text = visible(label);
    const float side = t.px(16);
    const float width = side + t.px(8) + ImGui::CalcTextSize(text.c_str()).x;
    const bool pressed = ImGui::InvisibleButton(label, {width, t.row});
    c.note(text);
    if (pressed) value = !value;
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float top = std::floor((min.y + max.y - side) * 0.5f);
    const ImVec2 a(min.x, top), b(min.x + side, top + side);
    list.AddRectFilled(a, b, value ? t.accent : t.field, t.radius);
    if (!value) list.AddRect(a, b, t.off, t.radius);
    if (value) icon_in(c, list, a, b, t.on_accent, icons::kCheck);
    text_in(list, t.regular, {min.x + side + t.px(8), min.y}, max, t.text, text.c_str(), 0);
    if (tip) tooltip(c, tip);
    return pressed;
}

void heading(Ctx& c, const char* text) {
    ImGui::PushFont(c.theme.strong);
    ImGui::TextUnformatted(text);
    ImGui::PopFont();
}

void quiet(Ctx& c, const char* text) {
    ImGui::PushStyleColor(ImGuiCol_Text, c.theme.quiet);
    ImGui::TextUnformatted(fitted(text, ImGui::GetContentRegionAvail().x).c_str());
    ImGui::PopStyleColor();
}

void wrapped(Ctx& c, const std::string& text, ImU32 color) {
    const std::string lines =
        wrapped_at_words(text, ImGui::GetContentRegionAvail().x, [](std::string_view part) {
            return ImGui::CalcTextSize(part.data(), part.data() + part.size()).x;
        });
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::PushTextWrapPos(0);  // for a path, which is wider than a line
    ImGui::TextUnformatted(lines.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    static_cast<void>(c);
}

void wrapped_in(Ctx& c, const std::string& text, ImU32 color, int lines) {
    const float top = ImGui::GetCursorPosY();
    wrapped(c, text, color);
    const float least = static_cast<float>(lines) * ImGui::GetTextLineHeight();
    const float below = top + least + ImGui::GetStyle().ItemSpacing.y;
    if (ImGui::GetCursorPosY() < below) ImGui::SetCursorPosY(below);
}

void empty_state(Ctx& c, const char* icon, const char* title, const char* what_to_do) {
    const Theme& t = c.theme;
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float wrap = std::min(room.x - t.px(16), t.px(380));
    const ImVec2 text_size = ImGui::CalcTextSize(what_to_do, nullptr, false, wrap);
    // In a low panel the words matter, not the icon.
    const float words = t.px(26) + text_size.y;
    const float above = room.y < t.px(36) + words + t.px(8) ? 0 : t.px(36);
    const float height = above + words;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float top = at.y + std::max(above > 0 ? t.px(8) : 0, (room.y - height) * 0.42f);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float middle = at.x + room.x * 0.5f;
    if (above > 0) {
        ImFont* font = t.display;
        const ImVec2 icon_size = font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, icon);
        list.AddText(font, font->FontSize, {middle - icon_size.x * 0.5f, top - t.px(6)}, t.off,
                     icon);
    }
    const float heading_top = top + above;
    text_in(list, t.strong, {at.x, heading_top}, {at.x + room.x, heading_top + t.px(20)}, t.text,
            title);
    const float left = std::floor(middle - std::min(wrap, text_size.x) * 0.5f);
    list.AddText(t.regular, t.regular->FontSize, {left, heading_top + t.px(26)}, t.quiet,
                 what_to_do, nullptr, wrap);
    ImGui::Dummy({room.x, std::min(room.y, height + t.px(40))});
}

void banner(Ctx& c, const char* icon, ImU32 color, const std::string& text) {
    const Theme& t = c.theme;
    const float width = ImGui::GetContentRegionAvail().x;
    const float wrap = width - t.px(36);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = std::max(t.row, size.y + t.px(10));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + width, at.y + height}, faded(color, 0.16f), t.radius);
    list.AddRectFilled(at, {at.x + t.px(3), at.y + height}, color, t.radius);
    icon_in(c, list, {at.x + t.px(6), at.y}, {at.x + t.px(26), at.y + t.row}, color, icon);
    list.AddText(t.regular, t.regular->FontSize,
                 {at.x + t.px(30), at.y + std::floor((height - size.y) * 0.5f)}, t.text,
                 text.c_str(), nullptr, wrap);
    ImGui::Dummy({width, height});
}

void progress_bar(Ctx& c, float fraction, const std::string& label, float width, float height) {
    const Theme& t = c.theme;
    if (width < 0) width = ImGui::GetContentRegionAvail().x;
    if (height == 0) height = t.px(18);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + width, at.y + height}, t.field, t.radius);
    const float full = std::clamp(fraction, 0.0f, 1.0f) * width;
    if (full > 1)
        list.AddRectFilled(at, {at.x + full, at.y + height}, faded(t.accent, 0.55f), t.radius);
    if (!label.empty())
        text_in(list, t.small, {at.x + t.px(6), at.y}, {at.x + width - t.px(6), at.y + height},
                t.text, fitted(label, width - t.px(12)).c_str(), 0);
    ImGui::Dummy({width, height});
}

bool chip(Ctx& c, const char* label, bool active) {
    const Theme& t = c.theme;
    const std::string text = visible(label);
    const float width =
        t.small->CalcTextSizeA(t.small->FontSize, FLT_MAX, 0, text.c_str()).x + t.px(18);
    const bool pressed = ImGui::InvisibleButton(label, {width, t.px(24)});
    c.note(text);
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(min, max, active ? faded(t.accent, 0.35f) : t.raised, t.px(12));
    if (ImGui::IsItemHovered()) list.AddRectFilled(min, max, t.hover, t.px(12));
    text_in(list, t.small, min, max, active ? t.text : t.quiet, text.c_str());
    return pressed;
}

bool begin_panel(Ctx& c, const char* name, ImVec2 size, ImU32 surface, bool scrolls,
                 float padding) {
    const float pad = padding < 0 ? c.theme.pad : padding;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {pad, pad});
    ImGui::PushStyleColor(ImGuiCol_ChildBg, surface);
    const bool open = ImGui::BeginChild(
        name, size, true,
        ImGuiWindowFlags_AlwaysUseWindowPadding |
            (scrolls ? ImGuiWindowFlags_None
                     : ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse));
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    c.panel = name;
    return open;
}

void end_panel(Ctx& c) {
    ImGui::EndChild();
    c.panel.clear();
}

}  // namespace weft::ui

// The strip of small results: frames of the shot, this frame with other textures or settings, or a
// contact sheet of settings on several frames.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "ui/base/icons.h"
#include "ui/canvas/handles.h"
#include "ui/light/light.h"
#include "ui/widgets/widgets.h"
#include "ui/widgets/wrap.h"

namespace weft::ui {
namespace {

// Textures to compare: favourites, then recently used ones.
std::vector<std::string> textures_to_try(const Ctx& c) {
    std::vector<std::string> out;
    const auto add = [&](const std::vector<std::string>& list) {
        constexpr std::size_t kMost = 4;
        for (const std::string& path : list)
            if (out.size() < kMost && !path.starts_with("db:") &&
                std::find(out.begin(), out.end(), path) == out.end())
                out.push_back(path);
    };
    add(c.settings.favourites);
    add(c.settings.recent_textures);
    for (const Leaf<Region>& region : c.view.project.regions)
        if (!region->texture.sample.empty()) add({region->texture.sample});
    if (const Region* region = c.view.selected_region()) std::erase(out, region->texture.sample);
    return out;
}

// In the middle of a card, in lines: the cards of a small window are narrow.
void text_in_card(Ctx& c, const std::string& text, ImVec2 min, ImVec2 max, ImU32 color) {
    const Theme& t = c.theme;
    const float width = max.x - min.x - t.px(6);
    ImGui::PushFont(t.small);
    std::istringstream lines(wrapped_at_words(text, width, [](std::string_view part) {
        return ImGui::CalcTextSize(part.data(), part.data() + part.size()).x;
    }));
    std::vector<std::string> shown;
    for (std::string line; std::getline(lines, line);)
        shown.push_back(fitted(line, width));
    const float line_h = ImGui::GetTextLineHeight();
    float y = (min.y + max.y - line_h * static_cast<float>(shown.size())) * 0.5f;
    std::string noted;
    for (const std::string& line : shown) {
        text_in(*ImGui::GetWindowDrawList(), t.small, {min.x, y}, {max.x, y + line_h}, color,
                line.c_str());
        noted += (noted.empty() ? "" : " ") + line;
        y += line_h;
    }
    c.note("Card: " + noted, min, max);
    ImGui::PopFont();
}

// On the picture, where it has room beside the label.
void provisional_mark(Ctx& c, ImVec2 min, ImVec2 max) {
    const Theme& t = c.theme;
    const ImVec2 top(min.x, max.y - t.px(18));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(top, max, t.scrim);
    ImGui::PushFont(t.small);
    const std::string text = fitted("Provisional", max.x - min.x - t.px(6));
    ImGui::PopFont();
    text_in(list, t.small, top, max, t.quiet, text.c_str());
    c.note("Mark: " + text, top, max);
}

// Draws the picture into `min`–`max`, or its state.
void picture_in(Ctx& c, const StripCard& one, ImVec2 min, ImVec2 max) {
    const Theme& t = c.theme;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(min, max, t.field, t.radius);
    if (one.picture) {
        const Vec2 shown =
            plate_aspect(c).unsqueezed(Vec2(static_cast<float>(one.picture->size.width),
                                            static_cast<float>(one.picture->size.height)));
        const float zoom = std::min((max.x - min.x) / shown.x, (max.y - min.y) / shown.y);
        const float w = zoom * shown.x, h = zoom * shown.y;
        const ImVec2 at(std::floor(min.x + (max.x - min.x - w) / 2),
                        std::floor(min.y + (max.y - min.y - h) / 2));
        if (const ImTextureID id = c.pictures.texture(one.picture))
            list.AddImageRounded(id, at, {at.x + w, at.y + h}, {0, 0}, {1, 1}, IM_COL32_WHITE,
                                 t.radius);
        if (one.provisional) provisional_mark(c, min, max);
        return;
    }
    // Wait for earlier cards or for the main picture.
    const PreviewView& preview = c.view.preview;
    const std::string waiting =
        preview.analysing && preview.total > 0
            ? "After the analysis, " + percent_text(preview.done, preview.total)
        : c.view.analysis_paused ? std::string("The analysis is paused")
                                 : std::string("Rendering…");
    const std::string text = one.error.empty() ? waiting : "No result";
    text_in_card(c, text, min, max, one.error.empty() ? t.quiet : t.bad);
}

void strip_card(Ctx& c, const StripCard& one, int index, ImVec2 at, ImVec2 size) {
    const Theme& t = c.theme;
    const bool frames = c.view.strip.kind == StripKind::kKeyframes;
    ImGui::SetCursorScreenPos(at);
    ImGui::PushID(index);
    if (ImGui::InvisibleButton("##card", size)) c.emit(ChooseFromStrip{index});
    ImGui::PopID();
    c.note(one.label);
    tooltip(c, !one.error.empty() ? one.error.c_str()
               : frames           ? "Go to this frame"
               : one.provisional  ? "Provisional: the exact picture follows. Use this setting; one "
                                    "undo step"
                                  : "Use this setting; one undo step");
    const ImVec2 max(at.x + size.x, at.y + size.y - t.px(20));
    picture_in(c, one, at, max);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool here = frames ? one.frame == c.view.frame : one.current;
    if (here || ImGui::IsItemHovered())
        list.AddRect({at.x - 1, at.y - 1}, {max.x + 1, max.y + 1},
                     here ? t.accent : faded(t.text, 0.5f), t.radius, 0, t.px(here ? 2 : 1));
    ImGui::PushFont(t.small);
    text_in(list, t.small, {at.x, max.y}, {max.x, at.y + size.y}, here ? t.text : t.quiet,
            fitted(one.label, size.x).c_str(), 0);
    ImGui::PopFont();
}

// A row of cards with their labels below.
void row_of_cards(Ctx& c, ImVec2 at, ImVec2 size, float aspect) {
    const Theme& t = c.theme;
    const auto& cards = c.view.strip.cards;
    const auto count = static_cast<float>(cards.size());
    const float gap = t.px(10);
    const float w =
        std::floor(std::min((size.x - gap * (count - 1)) / count, (size.y - t.px(20)) * aspect));
    for (std::size_t k = 0; k < cards.size(); ++k)
        strip_card(c, cards[k], static_cast<int>(k),
                   {at.x + static_cast<float>(k) * (w + gap), at.y}, {w, size.y});
}

// Settings as rows, each on the same frames. A button applies the setting; a picture goes to its
// frame.
void contact_sheet(Ctx& c, ImVec2 at, ImVec2 size, float aspect) {
    const Theme& t = c.theme;
    const auto& cards = c.view.strip.cards;
    const int columns = c.view.strip.columns;
    const int rows = static_cast<int>(cards.size()) / columns;
    const float gap = t.px(4), names = t.px(118), head = t.px(18);
    const float most_w = (size.x - names) / static_cast<float>(columns) - gap;
    const float most_h = (size.y - head) / static_cast<float>(rows) - gap;
    const float w = std::floor(std::min(most_w, most_h * aspect)), h = std::floor(w / aspect);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (int row = 0; row < rows; ++row) {
        const float y = at.y + head + static_cast<float>(row) * (h + gap);
        const std::size_t first = static_cast<std::size_t>(row * columns);
        ImGui::SetCursorScreenPos({at.x, y + std::floor((h - ImGui::GetFrameHeight()) / 2)});
        if (button(c, cards[first].label.c_str(),
                   {.look = cards[first].current ? Look::kPrimary : Look::kNormal,
                    .tip = cards[first].current ? "Current setting"
                                                : "Use this setting; one undo step",
                    .width = names - t.px(8)}))
            c.emit(ChooseFromStrip{static_cast<int>(first)});
        for (int column = 0; column < columns; ++column) {
            const StripCard& one = cards[first + static_cast<std::size_t>(column)];
            const ImVec2 min(at.x + names + static_cast<float>(column) * (w + gap), y);
            const ImVec2 max(min.x + w, min.y + h);
            ImGui::SetCursorScreenPos(min);
            ImGui::PushID(row * columns + column);
            if (ImGui::InvisibleButton("##cell", {w, h})) c.emit(GoToFrame{one.frame});
            ImGui::PopID();
            c.note(one.label + " " + std::to_string(one.frame));
            tooltip(c, one.error.empty() ? "Go to this frame" : one.error.c_str());
            picture_in(c, one, min, max);
            const bool here = one.frame == c.view.frame;
            if (ImGui::IsItemHovered())
                list.AddRect({min.x - 1, min.y - 1}, {max.x + 1, max.y + 1}, faded(t.text, 0.5f),
                             t.radius);
            if (row == 0)
                text_in(list, t.small, {min.x, at.y}, {max.x, at.y + head}, here ? t.text : t.quiet,
                        std::to_string(one.frame).c_str(), 0);
        }
    }
}

}  // namespace

void strip_panel(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    begin_panel(c, "Strip", size, t.panel, false, 0);
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddLine(origin, {origin.x + size.x, origin.y}, t.line);
    ImGui::SetCursorScreenPos({origin.x + t.px(10), origin.y + t.px(6)});
    int kind = std::max(0, static_cast<int>(c.state.strip) - 1);
    if (segments(c, "Compare", {"Keyframes", "Textures", "Scale", "Light", "Seams"}, kind,
                 t.px(420)))
        c.state.strip = static_cast<StripKind>(kind + 1);
    if (compares_settings(c.state.strip)) {
        ImGui::SameLine(0, t.px(16));
        checkbox(c, "Contact sheet", c.state.strip_over_time,
                 "Shows each setting on the same frames of the marked range or of the shot");
    }
    const StripView& strip = c.view.strip;
    // Tells the session what to show, and to stop when the panel is hidden.
    const std::vector<std::string> textures =
        c.state.strip == StripKind::kTextures ? textures_to_try(c) : std::vector<std::string>{};
    if (strip.kind != c.state.strip || textures != c.state.strip_textures ||
        strip.over_time != c.state.sheet()) {
        c.state.strip_textures = textures;
        c.emit(ShowStrip{c.state.strip, textures, c.state.sheet()});
    }
    const float top = t.px(40);
    if (strip.cards.empty() || strip.kind != c.state.strip || strip.over_time != c.state.sheet()) {
        ImGui::SetCursorScreenPos({origin.x, origin.y + top - t.px(8)});
        ImGui::BeginChild("Nothing", {size.x, size.y - top}, false);
        empty_state(c, icons::kFourUp, "Small results side by side",
                    c.view.plate.state == PlateView::State::kFailed
                        ? "They are rendered once the plate is found."
                        : "Give a region a matte and a texture to see variations here.");
        ImGui::EndChild();
        end_panel(c);
        return;
    }
    const Size plate = c.view.plate.size;
    const float aspect = plate.empty() ? 1.78f
                                       : plate_aspect(c).ratio() * static_cast<float>(plate.width) /
                                             static_cast<float>(plate.height);
    const ImVec2 at(origin.x + t.px(10), origin.y + top);
    const ImVec2 room(size.x - t.px(20), size.y - top - t.px(6));
    if (strip.columns > 0)
        contact_sheet(c, at, room, aspect);
    else
        row_of_cards(c, at, room, aspect);
    end_panel(c);
}

}  // namespace weft::ui

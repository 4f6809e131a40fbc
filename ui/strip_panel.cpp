// A row of small results: frames of the shot, or this frame with other textures or settings.
#include <algorithm>
#include <cmath>

#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace weft::ui {
namespace {

// What the texture card compares: what is liked, then what was used last.
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

void card(Ctx& c, const StripCard& one, int index, ImVec2 at, ImVec2 size) {
    const Theme& t = c.theme;
    const bool frames = c.view.strip.kind == StripKind::kKeyframes;
    ImGui::SetCursorScreenPos(at);
    ImGui::PushID(index);
    if (ImGui::InvisibleButton("##card", size)) c.emit(ChooseFromStrip{index});
    ImGui::PopID();
    c.note(one.label);
    tooltip(c, !one.error.empty() ? one.error.c_str()
               : frames           ? "Go to this frame"
                                  : "Use this; one step of the history");
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float caption = t.px(20);
    const ImVec2 max(at.x + size.x, at.y + size.y - caption);
    list.AddRectFilled(at, max, t.field, t.radius);
    if (one.picture) {
        const float zoom = std::min(size.x / static_cast<float>(one.picture->size.width),
                                    (max.y - at.y) / static_cast<float>(one.picture->size.height));
        const float w = zoom * static_cast<float>(one.picture->size.width);
        const float h = zoom * static_cast<float>(one.picture->size.height);
        const ImVec2 min(std::floor(at.x + (size.x - w) / 2),
                         std::floor(at.y + (max.y - at.y - h) / 2));
        if (const ImTextureID id = c.pictures.texture(one.picture))
            list.AddImageRounded(id, min, {min.x + w, min.y + h}, {0, 0}, {1, 1}, IM_COL32_WHITE,
                                 t.radius);
    } else {
        // What it waits for: the frames before it, or the picture that is looked at.
        const PreviewView& preview = c.view.preview;
        const std::string waiting = preview.analysing && preview.total > 0
                                        ? "After the analysis, " + std::to_string(preview.done) +
                                              "/" + std::to_string(preview.total)
                                    : c.view.analysis_paused ? std::string("The analysis is paused")
                                                             : std::string("Being worked out…");
        text_in(list, t.small, at, max, one.error.empty() ? t.quiet : t.bad,
                one.error.empty() ? waiting.c_str() : "No result");
    }
    const bool here = frames && one.frame == c.view.frame;
    if (here || ImGui::IsItemHovered())
        list.AddRect({at.x - 1, at.y - 1}, {max.x + 1, max.y + 1},
                     here ? t.accent : faded(t.text, 0.5f), t.radius, 0, t.px(here ? 2 : 1));
    ImGui::PushFont(t.small);
    text_in(list, t.small, {at.x, max.y}, {max.x, at.y + size.y}, here ? t.text : t.quiet,
            fitted(one.label, size.x).c_str(), 0);
    ImGui::PopFont();
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
    const StripView& strip = c.view.strip;
    // The session follows what is chosen here, and stops when nobody looks.
    const std::vector<std::string> textures =
        c.state.strip == StripKind::kTextures ? textures_to_try(c) : std::vector<std::string>{};
    if (strip.kind != c.state.strip || textures != c.state.strip_textures) {
        c.state.strip_textures = textures;
        c.emit(ShowStrip{c.state.strip, textures});
    }
    const float top = t.px(40), gap = t.px(10);
    if (strip.cards.empty() || strip.kind != c.state.strip) {
        ImGui::SetCursorScreenPos({origin.x, origin.y + top - t.px(8)});
        ImGui::BeginChild("Nothing", {size.x, size.y - top}, false);
        empty_state(
            c, icons::kFourUp, "Small results side by side",
            c.view.plate.state == PlateView::State::kFailed
                ? "They are made once the plate is found."
                : "Give a region a matte and a texture, and they are made here while you work.");
        ImGui::EndChild();
        end_panel(c);
        return;
    }
    const auto count = static_cast<float>(strip.cards.size());
    const float h = size.y - top - t.px(6);
    const Size plate = c.view.plate.size;
    const float aspect =
        plate.empty() ? 1.78f : static_cast<float>(plate.width) / static_cast<float>(plate.height);
    const float most_w = (size.x - t.px(20) - gap * (count - 1)) / count;
    const float w = std::floor(std::min(most_w, (h - t.px(20)) * aspect));
    float x = origin.x + t.px(10);
    for (std::size_t k = 0; k < strip.cards.size(); ++k, x += w + gap)
        card(c, strip.cards[k], static_cast<int>(k), {x, origin.y + top}, {w, h});
    end_panel(c);
}

}  // namespace weft::ui

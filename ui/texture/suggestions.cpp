// Suggestions for a region, or for all regions, with reasons.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "ui/base/icons.h"
#include "ui/canvas/handles.h"
#include "ui/texture/parts.h"
#include "ui/widgets/widgets.h"
#include "ui/widgets/wrap.h"

namespace weft::ui {

void texture_thumbnail(Ctx& c, const std::string& path, ImVec2 min, ImVec2 max) {
    const Theme& t = c.theme;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(min, max, t.field, t.radius);
    const PicturePtr picture = c.textures.thumbnail(path, static_cast<int>(t.px(128)));
    if (!picture) return;
    const ImTextureID id = c.pictures.texture(picture);
    if (!id) return;
    // A square from its centre.
    const float w = static_cast<float>(picture->size.width);
    const float h = static_cast<float>(picture->size.height);
    const float u = w > h ? 0.5f * (1 - h / w) : 0, v = h > w ? 0.5f * (1 - w / h) : 0;
    list.AddImageRounded(id, min, max, {u, v}, {1 - u, 1 - v}, IM_COL32_WHITE, t.radius);
}

void texture_drag_source(Ctx& c, const TextureCard& card) {
    if (!ImGui::BeginDragDropSource(ImGuiDragDropFlags_SourceAllowNullID)) return;
    ImGui::SetDragDropPayload("TEXTURE", card.path.c_str(), card.path.size() + 1);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = c.theme.px(72);
    ImGui::Dummy({side, side});
    texture_thumbnail(c, card.path, at, {at.x + side, at.y + side});
    ImGui::EndDragDropSource();
}

namespace {

// The heading, with the choice between one region and all.
void suggestion_heading(Ctx& c, const std::string& text) {
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, c.theme.quiet);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
    if (c.view.project.regions.size() < 2) return;
    ImGui::SameLine();
    if (chip(c, "All regions together", c.state.drawer.together))
        c.state.drawer.together = !c.state.drawer.together;
    tooltip(c, "Suggests one texture for each region, chosen to match");
}

constexpr int kReasonLines = 3;
constexpr float kReasonLine_px = 15;

// Cards get narrower before fewer than this many are shown: one of the first five suits.
constexpr int kWantedCards = 5;

float suggestion_width(const Theme& t, float room, float gap) {
    const float width = std::floor((room + gap) / kWantedCards) - gap;
    return std::clamp(width, t.px(124), t.px(148));
}

// A reason in lines of the present font, the last of them shortened if there are more.
std::vector<std::string> reason_lines(const std::string& reason, float width) {
    std::istringstream wrapped(wrapped_at_words(reason, width, [](std::string_view text) {
        return ImGui::CalcTextSize(text.data(), text.data() + text.size()).x;
    }));
    std::vector<std::string> out;
    for (std::string line; std::getline(wrapped, line);) {
        if (out.size() < kReasonLines)
            out.push_back(line);
        else
            out.back() = fitted(out.back() + " " + line, width);
    }
    return out;
}

// One suggestion: the current frame with the texture on it, and the reason.
void suggestion(Ctx& c, const TextureCard& card, const TextureSuggestion& why, ImVec2 at,
                ImVec2 size) {
    const Theme& t = c.theme;
    ImGui::SetCursorScreenPos(at);
    ImGui::PushID(card.path.c_str());
    const float h = size.y + t.px(22 + kReasonLines * kReasonLine_px);
    if (ImGui::InvisibleButton("##suggestion", {size.x, h})) c.state.drawer.picked = card.path;
    c.note(card.name);
    const bool hovered = ImGui::IsItemHovered();
    if (hovered && ImGui::IsMouseDoubleClicked(0)) c.emit(ApplyTexture{card.path, 0});
    tooltip(c,
            (card.name + ". " + why.reason + ". Double-click to apply it to the region").c_str());
    texture_drag_source(c, card);
    ImGui::PopID();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 max(at.x + size.x, at.y + size.y);
    list.AddRectFilled(at, max, t.field, t.radius);
    PicturePtr shown;
    const bool mine = c.view.strip.kind == StripKind::kSuggested;
    for (const StripCard& made : c.view.strip.cards)
        if (mine && made.note == card.path) shown = made.picture;
    const ImTextureID id = shown ? c.pictures.texture(shown) : nullptr;
    if (id) {
        // Crops the centre to the card's shape.
        const float pw = plate_aspect(c).ratio() * static_cast<float>(shown->size.width);
        const float ph = static_cast<float>(shown->size.height);
        const float wide = size.x / size.y, is = pw / ph;
        const float u = is > wide ? 0.5f * (1 - wide / is) : 0;
        const float v = is < wide ? 0.5f * (1 - is / wide) : 0;
        list.AddImageRounded(id, at, max, {u, v}, {1 - u, 1 - v}, IM_COL32_WHITE, t.radius);
        const float corner = t.px(30);
        texture_thumbnail(c, card.path, {max.x - corner, max.y - corner}, max);
    } else {
        // Shows the tiled texture until the result is ready.
        list.PushClipRect(at, max, true);
        for (float x = at.x; x < max.x; x += size.y)
            texture_thumbnail(c, card.path, {x, at.y}, {x + size.y, max.y});
        list.AddRectFilled({at.x, max.y - t.px(18)}, max, t.scrim);
        list.PopClipRect();
        text_in(list, t.small, {at.x, max.y - t.px(18)}, max, t.quiet, "Rendering…");
    }
    const bool picked = c.state.drawer.picked == card.path;
    if (picked || hovered)
        list.AddRect({at.x - 1, at.y - 1}, {max.x + 1, max.y + 1},
                     picked ? t.accent : faded(t.text, 0.5f), t.radius, 0, t.px(picked ? 2 : 1));
    ImGui::PushFont(t.small);
    text_in(list, t.small, {at.x, max.y + t.px(2)}, {max.x, max.y + t.px(19)}, t.text,
            fitted(card.name, size.x).c_str(), 0);
    float y = max.y + t.px(18);
    for (const std::string& line : reason_lines(why.reason, size.x)) {
        text_in(list, t.small, {at.x, y}, {max.x, y + t.px(kReasonLine_px)}, t.quiet, line.c_str(),
                0);
        y += t.px(kReasonLine_px);
    }
    ImGui::PopFont();
}

// A key of everything that the result depends on.
std::string together_key(const Ctx& c, const std::vector<TogetherRegion>& regions,
                         std::size_t cards) {
    std::string key = std::to_string(c.view.document) + "/" + std::to_string(cards) + "/" +
                      c.view.project.settings.excluded_licences;
    for (const TogetherRegion& region : regions)
        key += "/" + std::to_string(region.region) + ":" + region.keep;
    return key;
}

// The regions with a matte on this frame; textures to keep are named by library id.
std::vector<TogetherRegion> regions_together(const Ctx& c) {
    std::vector<TogetherRegion> out;
    for (const RegionMatteView& matte : c.view.mattes) {
        const Region* region = region_by_id(c.view.project, matte.region);
        if (!region || !region->enabled || !matte.keep) continue;
        TogetherRegion one{region->id, region->name, matte.keep, {}};
        const auto& kept = c.state.drawer.kept;
        if (std::find(kept.begin(), kept.end(), region->id) != kept.end())
            one.keep = library_name_of(region->texture.sample);
        out.push_back(std::move(one));
    }
    return out;
}

// A lock for each region with a library texture: keep this texture.
void keep_chips(Ctx& c, const std::vector<TogetherRegion>& regions) {
    std::vector<RegionId>& kept = c.state.drawer.kept;
    bool any = false;
    for (const TogetherRegion& one : regions) {
        const Region* region = region_by_id(c.view.project, one.region);
        if (!region || library_name_of(region->texture.sample).empty()) continue;
        if (!any) quiet(c, "Keep:");
        any = true;
        ImGui::SameLine();
        const auto at = std::find(kept.begin(), kept.end(), one.region);
        const bool on = at != kept.end();
        if (chip(c, (one.name + "##keep" + std::to_string(one.region)).c_str(), on)) {
            if (on)
                kept.erase(at);
            else
                kept.push_back(one.region);
            c.state.drawer.together_first = 0;
        }
        c.note("Keep " + one.name);
    }
}

void together_row(Ctx& c, const TogetherSuggestion& set, const std::vector<TogetherRegion>& regions,
                  int number, float side) {
    const Theme& t = c.theme;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    float x = at.x;
    ImGui::PushFont(t.small);
    for (std::size_t k = 0; k < regions.size() && k < set.paths.size(); ++k) {
        const bool kept = !regions[k].keep.empty();
        const std::string& path = kept ? regions[k].keep : set.paths[k];
        ImDrawList& list = *ImGui::GetWindowDrawList();
        texture_thumbnail(c, path, {x, at.y}, {x + side, at.y + side});
        if (kept)
            icon_in(c, list, {x + side - t.px(18), at.y}, {x + side, at.y + t.px(18)}, t.text,
                    icons::kLock);
        text_in(list, t.small, {x, at.y + side + t.px(2)}, {x + side, at.y + side + t.px(18)},
                t.quiet, fitted(regions[k].name, side).c_str(), 0);
        x += side + t.px(8);
    }
    ImGui::PopFont();
    ImGui::SetCursorScreenPos({x + t.px(4), at.y});
    ImGui::BeginGroup();
    if (button(c, ("Apply set##set" + std::to_string(number)).c_str(),
               {.icon = icons::kCheck,
                .look = number == 0 ? Look::kPrimary : Look::kNormal,
                .tip = "Applies them to all regions; one undo step"})) {
        ApplyTextures apply;
        for (std::size_t k = 0; k < regions.size() && k < set.paths.size(); ++k)
            if (regions[k].keep.empty() && !set.paths[k].empty())
                apply.textures.emplace_back(regions[k].region, set.paths[k]);
        c.emit(apply);
    }
    c.note("Apply set " + std::to_string(number + 1));
    quiet(c, set.why.c_str());
    ImGui::EndGroup();
    ImGui::SetCursorScreenPos({at.x, at.y + side + t.px(24)});
    ImGui::Dummy({0, 0});
}

}  // namespace

void suggested_together(Ctx& c, const std::vector<TextureCard>& cards) {
    const Theme& t = c.theme;
    const PanelName name(c, "Together");
    suggestion_heading(c, "For all regions, on this frame");
    const std::vector<TogetherRegion> regions = regions_together(c);
    if (regions.size() < 2) {
        quiet(c, "Two regions or more need a matte on this frame.");
        return;
    }
    const std::string key = together_key(c, regions, cards.size());
    if (c.view.plate_picture && !c.view.painting)
        c.textures.suggest_together(key, c.view.plate_picture, regions,
                                    c.view.project.settings.excluded_licences);
    keep_chips(c, regions);
    const auto found = c.textures.together(key);
    if (!found) {
        quiet(c, "Finding textures that match…");
        return;
    }
    if (found->empty()) {
        quiet(c, "No matching set found. Keep fewer textures, or search below.");
        return;
    }
    int& first = c.state.drawer.together_first;
    const int count = static_cast<int>(found->size());
    constexpr int kShown = 2;
    if (count > kShown) {
        ImGui::SameLine();
        if (button(c, "Shuffle", {.icon = icons::kRefresh, .tip = "Show another set"}))
            first += kShown;
    }
    if (first >= count) first = 0;
    for (int k = 0; k < std::min(kShown, count - first); ++k)
        together_row(c, (*found)[static_cast<std::size_t>(first + k)], regions, k, t.px(72));
}

void suggested(Ctx& c, const std::vector<TextureCard>& cards) {
    const Region* region = c.view.selected_region();
    if (!region) return;
    const Theme& t = c.theme;
    std::shared_ptr<const Matte> matte;
    bool none = c.view.plate_picture != nullptr;  // rather than not known yet
    for (const RegionMatteView& shown : c.view.mattes)
        if (shown.region == region->id) {
            matte = shown.keep;
            none &= !matte && shown.kind != RegionMatteView::Kind::kLoading;
        }
    const std::string& excluded = c.view.project.settings.excluded_licences;
    const std::string key = std::to_string(c.view.document) + "/" + std::to_string(region->id) +
                            "/" + std::to_string(cards.size()) + "/" + excluded + "/" +
                            region->name;
    if (matte && c.view.plate_picture && !cards.empty() && !c.view.painting)
        c.textures.suggest_for(key, {region->name, c.view.plate_picture, matte, excluded});
    const std::vector<TextureSuggestion> found = c.textures.suggestions(key);
    if (found.empty() && (none || c.textures.suggested(key))) {
        if (none) quiet(c, "Suggestions need the region's matte on this frame.");
        return;
    }
    const PanelName name(c, "Suggested");
    suggestion_heading(c, "Suggested for " + region->name + ", on this frame");
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float gap = t.px(10), room = ImGui::GetContentRegionAvail().x;
    const float w = suggestion_width(t, room, gap), h = t.px(92), step = w + gap;
    // Its room is kept while they are looked for, so that the textures below do not move away.
    const ImVec2 below(at.x, at.y + h + t.px(28 + kReasonLines * kReasonLine_px));
    const auto fit = static_cast<std::size_t>(std::max(1.0f, std::floor((room + gap) / step)));
    std::vector<std::string> paths;
    std::size_t shown = 0;
    for (const TextureSuggestion& s : found) {
        const auto card = std::find_if(cards.begin(), cards.end(),
                                       [&](const TextureCard& x) { return x.path == s.path; });
        if (shown == fit || card == cards.end()) continue;
        paths.push_back(s.path);
        suggestion(c, *card, s, {at.x + step * static_cast<float>(shown), at.y}, {w, h});
        ++shown;
    }
    // Rendered on the frame only while visible.
    if (c.view.strip.kind != StripKind::kSuggested || paths != c.state.strip_textures) {
        c.state.strip_textures = paths;
        c.emit(ShowStrip{StripKind::kSuggested, paths});
    }
    // The library knows textures before it lists them.
    if (shown == 0) quiet(c, ("Finding textures for " + region->name + "…").c_str());
    ImGui::SetCursorScreenPos(below);
    ImGui::Dummy({0, 0});
}

}  // namespace weft::ui

// The texture drawer: library, suggestions and large preview.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <unordered_map>

#include "engine/core/text.h"
#include "ui/base/icons.h"
#include "ui/texture/parts.h"
#include "ui/texture/texture.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

bool listed(const std::vector<std::string>& list, const std::string& path) {
    return std::find(list.begin(), list.end(), path) != list.end();
}

bool matches(const Ctx& c, const TextureCard& card, const std::string& wanted) {
    const DrawerState& d = c.state.drawer;
    if (!d.material.empty() && card.material != d.material) return false;
    if (d.favourites_only && !listed(c.settings.favourites, card.path)) return false;
    if (d.recent_only && !listed(c.settings.recent_textures, card.path)) return false;
    if (!d.collection.empty()) {
        const auto found = c.settings.collections.find(d.collection);
        if (found == c.settings.collections.end() || !listed(found->second, card.path))
            return false;
    }
    if (wanted.empty()) return true;
    std::string text = lower_case(card.name + " " + card.material);
    for (const std::string& tag : card.tags)
        text += " " + lower_case(tag);
    return text.find(wanted) != std::string::npos;
}

// Updates the shown cards if a condition has changed.
void update_cache(Ctx& c, const std::shared_ptr<const std::vector<TextureCard>>& cards) {
    DrawerState& d = c.state.drawer;
    DrawerCache& cache = d.cache;
    const std::string wanted = lower_case(d.search);
    // Prefer the library's search over matching letters.
    std::shared_ptr<const std::vector<std::string>> answered = c.textures.similar(d.similar_key);
    if (d.similar_key.empty()) {
        const TextureQuery question{wanted + (d.look.empty() ? "" : " " + d.look), d.origin,
                                    d.licence};
        d.answer = c.textures.search(question);
        if (d.answer) answered = {d.answer, &d.answer->paths};
    }
    std::size_t collected = 0;
    for (const auto& [name, paths] : c.settings.collections)
        collected += paths.size() + 1;
    std::string key = d.similar_key + "\n" + d.collection + std::to_string(collected) + "\n" +
                      wanted + "\n" + d.material + (d.favourites_only ? "\nf" : "\n") +
                      (d.recent_only ? "r" : "") + std::to_string(c.settings.favourites.size()) +
                      "/" + std::to_string(c.settings.recent_textures.size()) + "\n" + d.origin +
                      "\n" + d.licence + "\n" + d.look;
    if (cache.cards == cards && cache.answered == answered && cache.key == key) return;
    if (cache.cards != cards) {
        cache.materials.clear();
        for (const TextureCard& card : *cards)
            ++cache.materials[card.material];
    }
    cache.cards = cards;
    cache.answered = answered;
    cache.key = std::move(key);
    cache.shown.clear();
    if (answered) {
        std::unordered_map<std::string_view, const TextureCard*> by_path;
        for (const TextureCard& card : *cards)
            if (matches(c, card, "")) by_path[card.path] = &card;
        for (const std::string& path : *answered)
            if (const auto found = by_path.find(path); found != by_path.end())
                cache.shown.push_back(found->second);
    }
    for (const TextureCard& card : *cards)
        if (d.similar_key.empty() &&
            (card.path.starts_with("db:")
                 ? !answered
                 : d.origin.empty() && d.licence.empty() && d.look.empty()) &&
            matches(c, card, wanted))
            cache.shown.push_back(&card);
}

void materials(Ctx& c, const std::vector<TextureCard>& cards, ImVec2 size) {
    const Theme& t = c.theme;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {t.px(8), t.px(8)});
    ImGui::BeginChild("Materials", size, true, ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGui::PopStyleVar();
    const PanelName name(c, "Materials");
    DrawerState& d = c.state.drawer;
    const auto row = [&](const char* label, const char* icon, int count, bool active) {
        ImGui::PushID(label);
        const float w = ImGui::GetContentRegionAvail().x;
        const bool pressed = ImGui::InvisibleButton("##material", {w, t.px(24)});
        ImGui::PopID();
        c.note(label);
        const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        if (active) list.AddRectFilled(min, max, faded(t.accent, 0.28f), t.radius);
        if (ImGui::IsItemHovered()) list.AddRectFilled(min, max, t.hover, t.radius);
        icon_in(c, list, {min.x + t.px(2), min.y}, {min.x + t.px(22), max.y}, t.quiet, icon);
        text_in(list, t.regular, {min.x + t.px(28), min.y}, {max.x - t.px(40), max.y}, t.text,
                fitted(label, w - t.px(70)).c_str(), 0);
        text_in(list, t.small, min, {max.x - t.px(8), max.y}, t.quiet,
                std::to_string(count).c_str(), 1);
        return pressed;
    };
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, t.px(1)});
    const bool all =
        d.material.empty() && !d.favourites_only && !d.recent_only && d.collection.empty();
    const auto pick = [&](std::string material, bool favourites, bool recent) {
        d.similar_key.clear();
        d.collection.clear();
        d.material = std::move(material);
        d.favourites_only = favourites;
        d.recent_only = recent;
    };
    if (row("All textures", icons::kFourUp, static_cast<int>(cards.size()), all))
        pick("", false, false);
    if (row("Favourites", icons::kHeart, static_cast<int>(c.settings.favourites.size()),
            d.favourites_only))
        pick("", true, false);
    if (row("Recent", icons::kClock, static_cast<int>(c.settings.recent_textures.size()),
            d.recent_only))
        pick("", false, true);
    std::string gone;
    for (auto& [collection, paths] : c.settings.collections) {
        const bool shown = d.collection == collection;
        if (row(collection.c_str(), icons::kFolder, static_cast<int>(paths.size()), shown)) {
            pick("", false, false);
            d.collection = collection;
        }
        if (ImGui::BeginDragDropTarget()) {
            if (const ImGuiPayload* payload = ImGui::AcceptDragDropPayload("TEXTURE")) {
                const std::string path(static_cast<const char*>(payload->Data));
                if (!listed(paths, path)) paths.push_back(path);
            }
            ImGui::EndDragDropTarget();
        }
        if (shown && button(c, ("Delete " + collection).c_str(),
                            {.icon = icons::kClose,
                             .look = Look::kQuiet,
                             .tip = "The textures themselves are not deleted",
                             .width = -1}))
            gone = collection;
    }
    if (!gone.empty()) {
        c.settings.collections.erase(gone);
        pick("", false, false);
    }
    input(c, "New collection", d.new_collection, "New collection", -1, icons::kPlus);
    if (ImGui::IsItemDeactivated() && ImGui::IsKeyPressed(257) && !d.new_collection.empty()) {
        c.settings.collections.try_emplace(d.new_collection);
        d.new_collection.clear();
    }
    ImGui::Dummy({0, t.px(6)});
    for (const auto& [material, count] : c.state.drawer.cache.materials)
        if (row(material.c_str(), icons::kTagOutline, count, d.material == material))
            pick(material, false, false);
    ImGui::Dummy({0, t.px(6)});
    if (button(c, "Find by picture…",
               {.icon = icons::kMagnify,
                .look = Look::kQuiet,
                .tip = "Finds textures in the library that look like your picture",
                .width = -1})) {
        c.state.browser.purpose = BrowserState::Purpose::kSimilar;
        c.state.browser.just_opened = true;
    }
    if (button(c, "Add a folder…",
               {.icon = icons::kPlus,
                .look = Look::kQuiet,
                .tip = "Import your own textures, or browse a folder",
                .width = -1})) {
        c.state.browser.purpose = BrowserState::Purpose::kTextureFolder;
        c.state.browser.just_opened = true;
    }
    ImGui::PopStyleVar();
    ImGui::EndChild();
}

bool cell(Ctx& c, const TextureCard& card, ImVec2 at, float side, const char* caption) {
    const Theme& t = c.theme;
    ImGui::SetCursorScreenPos(at);
    const float h = side + t.px(20);
    ImGui::PushID(card.path.c_str());
    const bool pressed = ImGui::InvisibleButton("##texture", {side, h});
    c.note(caption);
    const bool hovered = ImGui::IsItemHovered();
    const bool twice = hovered && ImGui::IsMouseDoubleClicked(0);
    tooltip(c, (card.name + ". Double-click to apply it, or drag it onto a surface").c_str());
    texture_drag_source(c, card);
    ImGui::PopID();
    texture_thumbnail(c, card.path, at, {at.x + side, at.y + side});
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool picked = c.state.drawer.picked == card.path;
    if (picked || hovered)
        list.AddRect({at.x - 1, at.y - 1}, {at.x + side + 1, at.y + side + 1},
                     picked ? t.accent : faded(t.text, 0.5f), t.radius, 0, t.px(picked ? 2 : 1));
    ImGui::PushFont(t.small);
    text_in(list, t.small, {at.x, at.y + side + t.px(2)}, {at.x + side, at.y + side + t.px(18)},
            picked ? t.text : t.quiet, fitted(caption, side).c_str(), 0);
    ImGui::PopFont();
    if (pressed) c.state.drawer.picked = card.path;
    if (twice) c.emit(ApplyTexture{card.path, 0});
    return pressed;
}

void grid(Ctx& c, const std::vector<TextureCard>& cards, ImVec2 size) {
    const Theme& t = c.theme;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {t.px(10), t.px(8)});
    ImGui::BeginChild("Grid", size, true, ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGui::PopStyleVar();
    const PanelName name(c, "Textures");
    const std::string wanted = lower_case(c.state.drawer.search);
    const std::vector<const TextureCard*>& shown = c.state.drawer.cache.shown;
    DrawerState& d = c.state.drawer;
    if (!d.similar_key.empty()) {
        if (button(c, "Show all textures", {.icon = icons::kClose})) d.similar_key.clear();
        ImGui::SameLine();
        ImGui::AlignTextToFramePadding();
        const std::string like =
            d.similar_file.empty()
                ? "Similar to the selection on frame " + std::to_string(d.similar_frame)
                : "Like " + d.similar_file.substr(d.similar_file.find_last_of('/') + 1);
        quiet(c, (like + (c.textures.similar(d.similar_key) ? "" : "  ·  looking…")).c_str());
    } else if (wanted.empty() && d.material.empty() && d.collection.empty() && d.origin.empty() &&
               d.licence.empty() && d.look.empty() && !d.favourites_only && !d.recent_only) {
        d.together ? suggested_together(c, cards) : suggested(c, cards);
    } else if (d.answer && !d.answer->note.empty()) {
        quiet(c, d.answer->note.c_str());
    }
    if (shown.empty()) {
        if (!d.collection.empty())
            empty_state(c, icons::kFolder, "An empty collection",
                        "Drag textures onto its name on the left.");
        else if (cards.empty())
            empty_state(c, icons::kTexture, "No textures yet",
                        "Add a folder of surface pictures on the left.");
        else
            empty_state(c, icons::kMagnify, "Nothing found",
                        "Try another word, or select All textures on the left.");
        ImGui::EndChild();
        return;
    }
    const float side = t.thumb, gap = t.px(10), row_h = side + t.px(26);
    const float room = ImGui::GetContentRegionAvail().x;
    const int columns = std::max(1, static_cast<int>((room + gap) / (side + gap)));
    const int rows = (static_cast<int>(shown.size()) + columns - 1) / columns;
    // Draws only visible cards, and requests only their thumbnails.
    ImGuiListClipper clipper;
    clipper.Begin(rows, row_h);
    while (clipper.Step()) {
        for (int r = clipper.DisplayStart; r < clipper.DisplayEnd; ++r) {
            const ImVec2 at = ImGui::GetCursorScreenPos();
            for (int k = 0; k < columns; ++k) {
                const auto index = static_cast<std::size_t>(r * columns + k);
                if (index >= shown.size()) break;
                cell(c, *shown[index], {at.x + static_cast<float>(k) * (side + gap), at.y}, side,
                     shown[index]->name.c_str());
            }
            ImGui::SetCursorScreenPos(at);
            ImGui::Dummy({0, row_h - ImGui::GetStyle().ItemSpacing.y});
        }
    }
    ImGui::EndChild();
}

// The region's texture as its card names it; empty: it has none.
std::string own_texture(const Ctx& c) {
    const Region* region = c.view.selected_region();
    if (!region || !region->texture.plane.empty() || region->texture.sample.empty()) return {};
    const std::string& sample = region->texture.sample;
    if (std::string library = library_name_of(sample); !library.empty()) return library;
    const std::filesystem::path project = c.view.path;
    return std::filesystem::absolute(project.parent_path() / sample).lexically_normal().string();
}

// The selected texture, else that of the region, which need not be listed; no path: neither.
TextureCard large_card(Ctx& c, const std::vector<TextureCard>& cards) {
    TextureCard own;
    own.path = own_texture(c);
    if (!own.path.empty()) own.name = c.textures.name_of_texture(own.path);
    for (const TextureCard& card : cards) {
        if (card.path == c.state.drawer.picked) return card;
        if (card.path == own.path) own = card;
    }
    return own;
}

void large_texture(Ctx& c, const TextureCard& card) {
    const Theme& t = c.theme;
    const ImVec2 at = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
    const float picture_h = std::max(t.px(60), room.y - t.px(84));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 max(at.x + room.x, at.y + picture_h);
    list.AddRectFilled(at, max, t.field, t.radius);
    PicturePtr picture = c.textures.thumbnail(card.path, 512);
    if (!picture) picture = c.textures.thumbnail(card.path, static_cast<int>(t.px(128)));
    if (picture) {
        if (const ImTextureID id = c.pictures.texture(picture)) {
            // Tiled at one screen pixel per texel, to judge the joins.
            const float w = static_cast<float>(picture->size.width);
            const float h = static_cast<float>(picture->size.height);
            list.PushClipRect(at, max, true);
            for (float y = at.y; y < max.y; y += h)
                for (float x = at.x; x < max.x; x += w)
                    list.AddImage(id, {x, y}, {x + w, y + h});
            list.PopClipRect();
        }
    }
    ImGui::SetCursorScreenPos({at.x, max.y + t.px(6)});
    heading(c, fitted(card.name, room.x - t.px(40)).c_str());
    ImGui::SameLine(room.x - t.px(18));
    const bool favourite = listed(c.settings.favourites, card.path);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - t.px(4));
    if (icon_button(c, favourite ? icons::kHeart : icons::kHeartOutline, "Favourite", favourite,
                    nullptr, true, t.px(26))) {
        if (favourite)
            std::erase(c.settings.favourites, card.path);
        else
            c.settings.favourites.push_back(card.path);
    }
    const TextureCard known = c.textures.details(card);
    std::string facts = known.material;
    if (!known.author.empty()) facts += " · " + known.author;
    facts += (facts.empty() ? "" : " · ") +
             (known.licence.empty() ? "licence not stated" : known.licence);
    quiet(c, facts.c_str());
    if (button(c, "Apply to region",
               {.icon = icons::kCheck,
                .look = Look::kPrimary,
                .enabled = c.view.selected_region() != nullptr && card.path != own_texture(c),
                .width = -1}))
        c.emit(ApplyTexture{card.path, 0});
}

void large(Ctx& c, const TextureCard& card, ImVec2 size) {
    const Theme& t = c.theme;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {t.px(10), t.px(8)});
    ImGui::BeginChild("Large", size, true,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGui::PopStyleVar();
    const PanelName name(c, "Large");
    if (!card.path.empty())
        large_texture(c, card);
    else
        empty_state(c, icons::kTexture, "No texture selected", "Click one to see it large here.");
    ImGui::EndChild();
}

}  // namespace

void texture_drawer(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    begin_panel(c, "Drawer", size, t.panel, false, 0);
    const auto cards = c.textures.cards();
    update_cache(c, cards);
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine(origin, {origin.x + size.x, origin.y}, t.line);
    const float left = t.px(196), count_w = t.px(330);
    // The large preview always has its room: if it opened with the first click, the cards would
    // move from under the mouse.
    const float right = std::clamp(size.x * 0.2f, t.px(200), t.px(320));
    const float head = t.px(38), body = size.y - head;
    ImGui::SetCursorScreenPos({origin.x + t.px(10), origin.y + t.px(6)});
    input(c, "Search textures", c.state.drawer.search, "Search textures", t.px(260),
          icons::kMagnify);
    ImGui::SameLine(0, t.px(12));
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + t.px(2));
    texture_facets(c);
    const std::string activity = c.textures.activity();
    const bool narrowed = c.state.drawer.cache.shown.size() != cards->size();
    const std::string count =
        !activity.empty() ? activity
                          : (narrowed ? std::to_string(c.state.drawer.cache.shown.size()) + " of "
                                      : std::string()) +
                                std::to_string(cards->size()) + " textures";
    ImGui::PushFont(t.small);
    text_in(list, t.small, {origin.x + size.x - count_w, origin.y},
            {origin.x + size.x - t.px(12), origin.y + head}, t.quiet,
            fitted(count, count_w - t.px(14)).c_str(), 1);
    ImGui::PopFont();
    ImGui::SetCursorScreenPos({origin.x, origin.y + head});
    materials(c, *cards, {left, body});
    ImGui::SetCursorScreenPos({origin.x + left, origin.y + head});
    grid(c, *cards, {size.x - left - right, body});
    list.AddLine({origin.x + left, origin.y + head}, {origin.x + left, origin.y + size.y}, t.line);
    ImGui::SetCursorScreenPos({origin.x + size.x - right, origin.y + head});
    large(c, large_card(c, *cards), {right, body});
    list.AddLine({origin.x + size.x - right, origin.y + head},
                 {origin.x + size.x - right, origin.y + size.y}, t.line);
    end_panel(c);
}

}  // namespace weft::ui

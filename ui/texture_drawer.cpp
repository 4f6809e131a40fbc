// Textures: what there is, what suits the region, and one of them large.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace weft::ui {
namespace {

std::string lower(std::string text) {
    for (char& ch : text)
        ch = static_cast<char>(std::tolower(static_cast<unsigned char>(ch)));
    return text;
}

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
    std::string text = lower(card.name + " " + card.material);
    for (const std::string& tag : card.tags)
        text += " " + lower(tag);
    return text.find(wanted) != std::string::npos;
}

// Chooses what is shown, when something that it depends on has changed.
void update_cache(Ctx& c, const std::shared_ptr<const std::vector<TextureCard>>& cards) {
    DrawerState& d = c.state.drawer;
    DrawerCache& cache = d.cache;
    const std::string wanted = lower(d.search);
    // The library knows its words better than a comparison of letters does.
    std::shared_ptr<const std::vector<std::string>> answered = c.textures.similar(d.similar_key);
    if (d.similar_key.empty()) {
        const TextureQuestion question{wanted + (d.look.empty() ? "" : " " + d.look), d.origin,
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

void thumbnail(Ctx& c, const std::string& path, ImVec2 min, ImVec2 max) {
    const Theme& t = c.theme;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(min, max, t.field, t.radius);
    const PicturePtr picture = c.textures.thumbnail(path, static_cast<int>(t.px(128)));
    if (!picture) return;
    const ImTextureID id = c.pictures.texture(picture);
    if (!id) return;
    // A square out of its middle.
    const float w = static_cast<float>(picture->size.width);
    const float h = static_cast<float>(picture->size.height);
    const float u = w > h ? 0.5f * (1 - h / w) : 0, v = h > w ? 0.5f * (1 - w / h) : 0;
    list.AddImageRounded(id, min, max, {u, v}, {1 - u, 1 - v}, IM_COL32_WHITE, t.radius);
}

void drag_source(Ctx& c, const TextureCard& card) {
    if (!ImGui::BeginDragDropSource(ImGuiDragDropFlags_SourceAllowNullID)) return;
    ImGui::SetDragDropPayload("TEXTURE", card.path.c_str(), card.path.size() + 1);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = c.theme.px(72);
    ImGui::Dummy({side, side});
    thumbnail(c, card.path, at, {at.x + side, at.y + side});
    ImGui::EndDragDropSource();
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
                             .tip = "The textures stay where they are",
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
    if (button(c, "Add a folder…", {.icon = icons::kPlus, .look = Look::kQuiet, .width = -1})) {
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
    drag_source(c, card);
    ImGui::PopID();
    thumbnail(c, card.path, at, {at.x + side, at.y + side});
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

// One suggestion: the artist's own frame with the texture on it, and why.
void suggestion(Ctx& c, const TextureCard& card, const TextureSuggestion& why, ImVec2 at,
                ImVec2 size) {
    const Theme& t = c.theme;
    ImGui::SetCursorScreenPos(at);
    ImGui::PushID(card.path.c_str());
    const float h = size.y + t.px(38);
    if (ImGui::InvisibleButton("##suggestion", {size.x, h})) c.state.drawer.picked = card.path;
    c.note(card.name);
    const bool hovered = ImGui::IsItemHovered();
    if (hovered && ImGui::IsMouseDoubleClicked(0)) c.emit(ApplyTexture{card.path, 0});
    tooltip(c, (card.name + ". " + why.reason + ". Double-click puts it on the region").c_str());
    drag_source(c, card);
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
        // Filled, its middle cut to the card's shape.
        const float pw = static_cast<float>(shown->size.width);
        const float ph = static_cast<float>(shown->size.height);
        const float wide = size.x / size.y, is = pw / ph;
        const float u = is > wide ? 0.5f * (1 - wide / is) : 0;
        const float v = is < wide ? 0.5f * (1 - is / wide) : 0;
        list.AddImageRounded(id, at, max, {u, v}, {1 - u, 1 - v}, IM_COL32_WHITE, t.radius);
        const float corner = t.px(30);
        thumbnail(c, card.path, {max.x - corner, max.y - corner}, max);
    } else {
        // Until it is made the texture itself, repeated.
        list.PushClipRect(at, max, true);
        for (float x = at.x; x < max.x; x += size.y)
            thumbnail(c, card.path, {x, at.y}, {x + size.y, max.y});
        list.AddRectFilled({at.x, max.y - t.px(18)}, max, t.scrim);
        list.PopClipRect();
        text_in(list, t.small, {at.x, max.y - t.px(18)}, max, t.quiet, "on its way…");
    }
    const bool picked = c.state.drawer.picked == card.path;
    if (picked || hovered)
        list.AddRect({at.x - 1, at.y - 1}, {max.x + 1, max.y + 1},
                     picked ? t.accent : faded(t.text, 0.5f), t.radius, 0, t.px(picked ? 2 : 1));
    ImGui::PushFont(t.small);
    text_in(list, t.small, {at.x, max.y + t.px(2)}, {max.x, max.y + t.px(19)}, t.text,
            fitted(card.name, size.x).c_str(), 0);
    text_in(list, t.small, {at.x, max.y + t.px(18)}, {max.x, max.y + t.px(36)}, t.quiet,
            fitted(why.reason, size.x).c_str(), 0);
    ImGui::PopFont();
}

void suggested(Ctx& c, const std::vector<TextureCard>& cards) {
    const Region* region = c.view.selected_region();
    if (!region) return;
    const Theme& t = c.theme;
    std::shared_ptr<const Matte> matte;
    for (const RegionMatteView& shown : c.view.mattes)
        if (shown.region == region->id) matte = shown.keep;
    const std::string& excluded = c.view.project.settings.excluded_licences;
    const std::string key =
        std::to_string(region->id) + "/" + std::to_string(cards.size()) + "/" + excluded;
    if (matte && c.view.plate_picture && !cards.empty() && !c.view.painting)
        c.textures.suggest_for(key, c.view.plate_picture, matte, excluded);
    const std::vector<TextureSuggestion> found = c.textures.suggestions(key);
    if (found.empty()) {
        if (!c.textures.suggested(key))
            quiet(c, ("Looking for textures that suit " + region->name + "…").c_str());
        return;
    }
    const PanelName name(c, "Suggested");
    ImGui::PushStyleColor(ImGuiCol_Text, t.quiet);
    ImGui::TextUnformatted(("Suggested for " + region->name + ", on this frame").c_str());
    ImGui::PopStyleColor();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float w = t.px(148), h = t.px(92), step = w + t.px(10);
    const float room = ImGui::GetContentRegionAvail().x;
    const auto fit = static_cast<std::size_t>(std::max(1.0f, std::floor((room + t.px(10)) / step)));
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
    // Rendered on the frame while somebody looks at them.
    if (c.view.strip.kind != StripKind::kSuggested || paths != c.state.strip_textures) {
        c.state.strip_textures = paths;
        c.emit(ShowStrip{StripKind::kSuggested, paths});
    }
    ImGui::SetCursorScreenPos({at.x, at.y + h + t.px(44)});
    ImGui::Dummy({0, 0});
}

void grid(Ctx& c, const std::vector<TextureCard>& cards, ImVec2 size) {
    const Theme& t = c.theme;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {t.px(10), t.px(8)});
    ImGui::BeginChild("Grid", size, true, ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGui::PopStyleVar();
    const PanelName name(c, "Textures");
    const std::string wanted = lower(c.state.drawer.search);
    const std::vector<const TextureCard*>& shown = c.state.drawer.cache.shown;
    DrawerState& d = c.state.drawer;
    if (!d.similar_key.empty()) {
        if (button(c, "All textures again", {.icon = icons::kClose})) d.similar_key.clear();
        ImGui::SameLine();
        ImGui::AlignTextToFramePadding();
        quiet(c, ("Like the rectangle on frame " + std::to_string(d.similar_frame) +
                  (c.textures.similar(d.similar_key) ? "" : "  ·  looking…"))
                     .c_str());
    } else if (wanted.empty() && d.material.empty() && d.collection.empty() && d.origin.empty() &&
               d.licence.empty() && d.look.empty() && !d.favourites_only && !d.recent_only) {
        suggested(c, cards);
    }
    if (shown.empty()) {
        if (!d.collection.empty())
            empty_state(c, icons::kFolder, "An empty collection",
                        "Drag textures onto its name on the left.");
        else if (cards.empty())
            empty_state(c, icons::kTexture, "No textures yet",
                        "Add a folder with pictures of surfaces, on the left.");
        else
            empty_state(c, icons::kMagnify, "Nothing found",
                        "Try another word, or all textures on the left.");
        ImGui::EndChild();
        return;
    }
    const float side = t.thumb, gap = t.px(10), row_h = side + t.px(26);
    const float room = ImGui::GetContentRegionAvail().x;
    const int columns = std::max(1, static_cast<int>((room + gap) / (side + gap)));
    const int rows = (static_cast<int>(shown.size()) + columns - 1) / columns;
    // Only what is seen is drawn, and only that asks for its thumbnails.
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

void large(Ctx& c, const TextureCard& card, ImVec2 size) {
    const Theme& t = c.theme;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {t.px(10), t.px(8)});
    ImGui::BeginChild("Large", size, true,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGui::PopStyleVar();
    const PanelName name(c, "Large");
    const ImVec2 at = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
    const float picture_h = std::max(t.px(60), room.y - t.px(84));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 max(at.x + room.x, at.y + picture_h);
    list.AddRectFilled(at, max, t.field, t.radius);
    if (const PicturePtr picture = c.textures.thumbnail(card.path, 512)) {
        if (const ImTextureID id = c.pictures.texture(picture)) {
            // Repeated, at one screen pixel a texel, so that its joins can be judged.
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
    facts += " · " + (known.licence.empty() ? "licence not stated" : known.licence);
    quiet(c, facts.c_str());
    if (button(c, "Put it on the region",
               {.icon = icons::kCheck,
                .look = Look::kPrimary,
                .enabled = c.view.selected_region() != nullptr,
                .width = -1}))
        c.emit(ApplyTexture{card.path, 0});
    ImGui::EndChild();
}

// Words of the library's own that say how a texture looks.
constexpr const char* kLooks[] = {"dark", "light",  "rough",  "smooth",    "striped", "regular",
                                  "fine", "coarse", "glossy", "colourful", "warm",    "cold"};

// One chip that opens a list; an entry is taken or given back.
void chip_list(Ctx& c, const char* name, std::string& value,
               const std::vector<TextureCount>& entries) {
    const Theme& t = c.theme;
    const std::string label =
        (value.empty() ? std::string(name) : fitted(value, t.px(110))) + "##" + name;
    ImGui::PushID(name);
    if (ui::chip(c, label.c_str(), !value.empty())) ImGui::OpenPopup("##entries");
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {t.px(6), t.px(6)});
    if (ImGui::BeginPopup("##entries")) {
        const PanelName within(c, name);
        if (ImGui::MenuItem("Any", nullptr, value.empty())) value.clear();
        c.note("Any");
        for (const TextureCount& entry : entries) {
            const std::string count = entry.count > 0 ? std::to_string(entry.count) : "";
            if (ImGui::MenuItem(entry.value.c_str(), count.c_str(), value == entry.value))
                value = value == entry.value ? "" : entry.value;
            c.note(entry.value);
        }
        ImGui::EndPopup();
    }
    ImGui::PopStyleVar();
    ImGui::PopID();
}

// Where the textures come from, under which licence, and what they look like.
void facets(Ctx& c) {
    DrawerState& d = c.state.drawer;
    const auto all = c.textures.everything();
    if (!all) return;
    const PanelName name(c, "Facets");
    const auto& counts = d.answer ? *d.answer : *all;
    const auto origin = [&](const char* value, const char* label) {
        int count = 0;
        for (const TextureCount& one : counts.origins)
            if (one.value == value) count = one.count;
        const bool active = d.origin == value;
        if (count == 0 && !active) return;
        if (chip(c, (std::string(label) + " " + std::to_string(count)).c_str(), active))
            d.origin = active ? "" : value;
        ImGui::SameLine();
    };
    origin("package", "Photographs");
    origin("procedural", "Procedural");
    origin("file", "Own");
    chip_list(c, "Licence", d.licence, all->licences);
    ImGui::SameLine();
    std::vector<TextureCount> looks;
    for (const char* look : kLooks)
        looks.push_back({look, 0});
    chip_list(c, "Look", d.look, looks);
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
    const float left = t.px(196), count_w = t.px(260);
    // One texture, large: once one is picked. Until then its room belongs to the others.
    const auto picked = std::find_if(cards->begin(), cards->end(), [&](const TextureCard& card) {
        return card.path == c.state.drawer.picked;
    });
    // It opens a moment after the click: the second click of a double one finds the same texture.
    DrawerState& d = c.state.drawer;
    constexpr double kMomentS = 0.35;
    if (picked == cards->end()) d.large_shown = false;
    d.large_due = picked != cards->end() && !d.large_shown;
    if (d.large_due && ImGui::GetTime() - ImGui::GetIO().MouseClickedTime[0] > kMomentS)
        d.large_shown = true;
    const float right = d.large_shown ? std::clamp(size.x * 0.24f, t.px(200), t.px(320)) : 0;
    const float head = t.px(38), body = size.y - head;
    ImGui::SetCursorScreenPos({origin.x + t.px(10), origin.y + t.px(6)});
    input(c, "Search textures", c.state.drawer.search, "Search textures", t.px(260),
          icons::kMagnify);
    ImGui::SameLine(0, t.px(12));
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + t.px(2));
    facets(c);
    const std::string activity = c.textures.activity();
    const bool narrowed = c.state.drawer.cache.shown.size() != cards->size();
    const std::string count =
        !activity.empty() ? activity
                          : (narrowed ? std::to_string(c.state.drawer.cache.shown.size()) + " of "
                                      : std::string()) +
                                std::to_string(cards->size()) + " textures";
    text_in(list, t.small, {origin.x + size.x - count_w, origin.y},
            {origin.x + size.x - t.px(12), origin.y + head}, t.quiet,
            fitted(count, count_w - t.px(20)).c_str(), 1);
    ImGui::SetCursorScreenPos({origin.x, origin.y + head});
    materials(c, *cards, {left, body});
    ImGui::SetCursorScreenPos({origin.x + left, origin.y + head});
    grid(c, *cards, {size.x - left - right, body});
    list.AddLine({origin.x + left, origin.y + head}, {origin.x + left, origin.y + size.y}, t.line);
    if (right > 0) {
        ImGui::SetCursorScreenPos({origin.x + size.x - right, origin.y + head});
        large(c, *picked, {right, body});
        list.AddLine({origin.x + size.x - right, origin.y + head},
                     {origin.x + size.x - right, origin.y + size.y}, t.line);
    }
    end_panel(c);
}

}  // namespace weft::ui

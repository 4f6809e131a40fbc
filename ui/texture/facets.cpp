// Filter chips of the library.
#include "ui/base/icons.h"
#include "ui/texture/parts.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

// The library's words for how a texture looks.
constexpr const char* kLooks[] = {"dark", "light",  "rough",  "smooth",    "striped", "regular",
                                  "fine", "coarse", "glossy", "colourful", "warm",    "cold"};

// A chip with a list; an entry is selected or cleared.
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

}  // namespace

// Filters by origin, licence and look.
void texture_facets(Ctx& c) {
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

}  // namespace weft::ui

// What the right mouse button offers on a region's row.
#include "ui/inspector/region_menu.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

bool item(Ctx& c, const char* name, const char* command = nullptr) {
    const std::string key = command ? c.commands.key_of(command) : std::string();
    const bool pressed = ImGui::MenuItem(name, key.c_str());
    c.note(name);
    return pressed;
}

}  // namespace

void begin_renaming(Ctx& c, const Region& region) {
    c.state.renaming = region.id;
    c.state.rename_text = region.name;
}

void region_menu(Ctx& c, const Region& region) {
    const Theme& t = c.theme;
    // The commands are for the selected region.
    if (ImGui::IsItemClicked(1) && c.view.selected != region.id) c.emit(SelectRegion{region.id});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {t.px(6), t.px(6)});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {t.px(8), t.px(6)});
    if (ImGui::BeginPopupContextItem("##region menu")) {
        const PanelName within(c, "Region menu");
        const bool solo = c.view.solo == region.id, locked = c.view.is_locked(region.id);
        if (item(c, "Rename")) begin_renaming(c, region);
        if (item(c, "Duplicate", "region.duplicate")) c.commands.run("region.duplicate", c);
        ImGui::Separator();
        if (item(c, region.enabled ? "Hide" : "Show"))
            c.edit(SetRegionParameter{{region.id, {}}, "enabled", !region.enabled});
        if (item(c, solo ? "End solo" : "Solo")) c.emit(SoloRegion{solo ? 0 : region.id});
        if (item(c, locked ? "Unlock" : "Lock")) c.emit(LockRegion{region.id, !locked});
        ImGui::Separator();
        if (item(c, "Delete", "region.remove")) c.commands.run("region.remove", c);
        ImGui::EndPopup();
    }
    ImGui::PopStyleVar(2);
}

}  // namespace weft::ui

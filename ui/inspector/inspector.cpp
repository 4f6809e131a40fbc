// The inspector: the list of regions, then the workspace's sections.
#include <algorithm>
#include <cmath>

#include "ui/base/icons.h"
#include "ui/inspector/inspector.h"
#include "ui/inspector/region_menu.h"
#include "ui/light/light.h"
#include "ui/mask/mask.h"
#include "ui/motion/motion.h"
#include "ui/review/review.h"
#include "ui/texture/texture.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {

namespace {

void region_list(Ctx& c) {
    const Theme& t = c.theme;
    const SessionView& v = c.view;
    const PanelName panel(c, "Regions");
    heading(c, "Regions");
    ImGui::SameLine(ImGui::GetContentRegionAvail().x - t.px(26) + ImGui::GetCursorPosX() -
                    ImGui::GetCursorStartPos().x);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - t.px(4));
    if (icon_button(c, icons::kPlus, "Add region", false, "region.add", v.open, t.px(26)))
        c.commands.run("region.add", c);
    if (v.project.regions.empty()) {
        quiet(c, "No regions yet. Add the surface to replace.");
        if (button(c, "Add region##first",
                   {.icon = icons::kPlus, .look = Look::kPrimary, .enabled = v.open, .width = -1}))
            c.commands.run("region.add", c);
        return;
    }
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, t.px(2)});
    const float width = ImGui::GetContentRegionAvail().x;
    // Top layer first, like a layer list.
    for (std::size_t row = v.project.regions.size(); row-- > 0;) {
        const Region& region = *v.project.regions[row];
        ImGui::PushID(static_cast<int>(region.id));
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float h = t.px(34);
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const bool selected = region.id == v.selected;
        if (selected)
            list.AddRectFilled(at, {at.x + width, at.y + h}, faded(t.accent, 0.26f), t.radius);
        list.AddRectFilled({at.x, at.y + t.px(4)}, {at.x + t.px(4), at.y + h - t.px(4)},
                           region_color(region.color, region.id), t.px(2));
        ImGui::SetCursorScreenPos({at.x + t.px(8), at.y + t.px(4)});
        if (icon_button(c, region.enabled ? icons::kEye : icons::kEyeOff,
                        ((region.enabled ? "Hide " : "Show ") + region.name).c_str(), false,
                        nullptr, true, t.px(26)))
            c.edit(SetRegionParameter{{region.id, {}}, "enabled", !region.enabled});
        const float buttons = t.px(56);
        const float name_x = at.x + t.px(40), name_w = width - t.px(40) - buttons;
        ImGui::SetCursorScreenPos({name_x, at.y});
        if (c.state.renaming == region.id) {
            ImGui::SetCursorScreenPos({name_x - t.px(6), at.y + t.px(4)});
            if (!ImGui::IsAnyItemActive()) ImGui::SetKeyboardFocusHere();
            input(c, "Rename", c.state.rename_text, "Name", name_w);
            if (ImGui::IsItemDeactivated() || ImGui::IsKeyPressed(257)) {
                if (!c.state.rename_text.empty() && c.state.rename_text != region.name &&
                    !ImGui::IsKeyPressed(256))
                    c.edit(RenameRegion{{region.id, {}}, c.state.rename_text});
                c.state.renaming = 0;
            }
        } else {
            if (ImGui::InvisibleButton("##row", {name_w, h}) && !selected)
                c.emit(SelectRegion{region.id});
            c.note(region.name);
            if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) begin_renaming(c, region);
            region_menu(c, region);
            if (ImGui::BeginDragDropSource()) {
                ImGui::SetDragDropPayload("REGION", &region.id, sizeof region.id);
                ImGui::TextUnformatted(region.name.c_str());
                ImGui::EndDragDropSource();
            }
            if (ImGui::BeginDragDropTarget()) {
                if (const ImGuiPayload* payload = ImGui::AcceptDragDropPayload("REGION"))
                    c.edit(MoveRegion{{*static_cast<const RegionId*>(payload->Data), {}},
                                      static_cast<int>(row)});
                if (const ImGuiPayload* payload = ImGui::AcceptDragDropPayload("TEXTURE"))
                    c.emit(ApplyTexture{static_cast<const char*>(payload->Data), region.id});
                ImGui::EndDragDropTarget();
            }
            const auto missing = v.unready.find(region.id);
            const bool ready = missing == v.unready.end();
            const std::string texture =
                !region.texture.plane.empty() ? region.texture.plane : region.texture.sample;
            const std::string below = ready ? c.textures.name_of_texture(texture) : missing->second;
            text_in(list, selected ? t.strong : t.regular, {name_x, at.y + t.px(2)},
                    {name_x + name_w, at.y + t.px(19)}, region.enabled ? t.text : t.off,
                    fitted(region.name, name_w).c_str(), 0);
            ImGui::PushFont(t.small);
            text_in(list, t.small, {name_x, at.y + t.px(17)}, {name_x + name_w, at.y + h},
                    ready ? t.quiet : t.warn, fitted(below, name_w).c_str(), 0);
            ImGui::PopFont();
        }
        ImGui::SetCursorScreenPos({at.x + width - buttons, at.y + t.px(4)});
        const bool solo = v.solo == region.id, locked = v.is_locked(region.id);
        if (icon_button(c, icons::kSolo, ("Solo " + region.name).c_str(), solo, nullptr, true,
                        t.px(26)))
            c.emit(SoloRegion{solo ? 0 : region.id});
        ImGui::SameLine(0, t.px(2));
        if (icon_button(c, locked ? icons::kLock : icons::kLockOpen,
                        ((locked ? "Unlock " : "Lock ") + region.name).c_str(), locked, nullptr,
                        true, t.px(26)))
            c.emit(LockRegion{region.id, !locked});
        ImGui::SetCursorScreenPos({at.x, at.y + h});
        ImGui::Dummy({width, 0});
        ImGui::PopID();
    }
    ImGui::PopStyleVar();
}

void inspector_contents(Ctx& c) {
    if (!c.view.open) {
        empty_state(c, icons::kLayers, "Nothing open", "Open a shot to see its regions here.");
        return;
    }
    region_list(c);
    ImGui::Dummy({0, c.theme.px(4)});
    switch (c.state.workspace) {
        case Workspace::kMask:
            mask_inspector(c);
            break;
        case Workspace::kTexture:
            texture_inspector(c);
            break;
        case Workspace::kMotion:
            motion_inspector(c);
            break;
        case Workspace::kLight:
            light_inspector(c);
            break;
        case Workspace::kReview:
            review_inspector(c);
            break;
        case Workspace::kJobs:
            break;
    }
}

}  // namespace

void inspector(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    ImGui::PushID(static_cast<int>(c.state.workspace));  // each keeps its own scroll position
    begin_panel(c, "Inspector", size, t.panel, true, t.px(10));
    inspector_contents(c);
    end_panel(c);
    ImGui::PopID();
}

}  // namespace weft::ui

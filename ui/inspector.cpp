// The right side: regions on top, then what the workspace is about.
#include <algorithm>
#include <cmath>

#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace weft::ui {
namespace {

void matte_source_card(Ctx& c, const Region& region) {
    const Theme& t = c.theme;
    const MatteSource& matte = *region.matte;
    if (!matte.files.empty()) {
        info_row(c, "Matte files", matte.files);
        if (button(c, "Paint instead",
                   {.icon = icons::kBrush,
                    .enabled = c.view.plate.state == PlateView::State::kOpen,
                    .tip = "Makes this frame's matte a painted keyframe; the other frames follow "
                           "from it",
                    .width = -1}))
            c.emit(PaintInstead{});
        return;
    }
    if (matte.keyframes.empty()) {
        banner(c, icons::kBrush, t.accent,
               "Paint over the surface with the brush (B). One frame is enough to begin; the "
               "others follow.");
        ImGui::Dummy({0, t.px(2)});
        if (button(c, "Use matte files…",
                   {.icon = icons::kFolderImage,
                    .tip = "A matte for every frame, from a sequence on disk",
                    .width = -1})) {
            c.state.browser.purpose = BrowserState::Purpose::kMatte;
            c.state.browser.just_opened = true;
        }
        return;
    }
    info_row(c, "Keyframes", std::to_string(matte.keyframes.size()));
    float least = 2;
    int worst = 0;
    for (std::size_t k = 0; k < c.view.marks.size(); ++k) {
        const float confidence = c.view.marks[k].confidence;
        if (confidence >= 0 && confidence < least) {
            least = confidence;
            worst = c.view.plate.frames[k];
        }
    }
    const float half = std::floor((ImGui::GetContentRegionAvail().x - t.gap) * 0.5f);
    const bool key_here = matte.keyframes.contains(c.view.frame);
    if (button(c, "Key here",
               {.icon = icons::kKeyframe,
                .enabled = !key_here,
                .tip = "Makes the matte of this frame a keyframe, to be corrected",
                .command = "region.key",
                .width = half}))
        c.emit(KeyMatteHere{});
    ImGui::SameLine();
    if (button(c, "Remove key",
               {.icon = icons::kClose,
                .enabled = key_here,
                .tip = "The frame follows its neighbours again",
                .width = half}))
        c.edit(RemoveMatteKeyframe{{region.id, {}}, c.view.frame});
    auto before = matte.keyframes.lower_bound(c.view.frame);
    const bool can_copy = before != matte.keyframes.begin() && !key_here;
    if (button(c, "Copy the key before",
               {.icon = icons::kCopy,
                .enabled = can_copy,
                .tip = "Puts the nearest earlier keyframe's matte here",
                .width = -1}))
        c.emit(CopyKeyframe{std::prev(before)->first, c.view.frame});
    if (least <= 1 && least < 0.8f && worst != c.view.frame) {
        ImGui::Dummy({0, t.px(2)});
        banner(c, icons::kAlert, t.warn,
               "Frame " + std::to_string(worst) + " is the least sure (" +
                   number_text(100.0 * static_cast<double>(least), 0) +
                   "%). A keyframe there helps most.");
        if (button(c, "Go there", {.icon = icons::kArrowRight, .width = -1}))
            c.emit(GoToFrame{worst});
    }
}

void no_region(Ctx& c) {
    empty_state(c, icons::kLayers, "No region selected",
                "A region is one surface that gets a new texture. Add one above, then paint its "
                "matte.");
}

}  // namespace

// ---- regions ---------------------------------------------------------------------------------

void region_list(Ctx& c) {
    const Theme& t = c.theme;
    const SessionView& v = c.view;
    const PanelName panel(c, "Regions");
    heading(c, "Regions");
    ImGui::SameLine(ImGui::GetContentRegionAvail().x - t.px(26) + ImGui::GetCursorPosX() -
                    ImGui::GetCursorStartPos().x);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - t.px(4));
    if (icon_button(c, icons::kPlus, "Add a region", false, "region.add", v.open, t.px(26)))
        c.commands.run("region.add", c);
    if (v.project.regions.empty()) {
        quiet(c, "None yet. Add the surface to be replaced.");
        if (button(c, "Add a region##first",
                   {.icon = icons::kPlus, .look = Look::kPrimary, .enabled = v.open, .width = -1}))
            c.commands.run("region.add", c);
        return;
    }
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, t.px(2)});
    const float width = ImGui::GetContentRegionAvail().x;
    // The topmost layer first, as layers are read.
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
            ImGui::SetKeyboardFocusHere();
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
            if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) {
                c.state.renaming = region.id;
                c.state.rename_text = region.name;
            }
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
            const std::size_t slash = texture.find_last_of('/');
            const std::string below =
                ready ? texture.substr(slash == std::string::npos ? 0 : slash + 1)
                      : missing->second;
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

// ---- workspaces ------------------------------------------------------------------------------

void mask_inspector(Ctx& c) {
    const Region* region = c.view.selected_region();
    if (!region) return no_region(c);
    const Theme& t = c.theme;
    const bool painting = c.state.tool == Tool::kBrush || c.state.tool == Tool::kEraser;
    if (section(c, painting                       ? "Brush"
                   : c.state.tool == Tool::kFlood ? "Select by colour"
                   : c.state.tool == Tool::kShape ? "Shape"
                                                  : "Tool")) {
        const PanelName panel(c, "Brush");
        Brush& b = c.state.brush.brush;
        const auto row = [&](SliderSpec spec, float& value) {
            double v = static_cast<double>(value);
            if (slider(c, spec, v) != Change::kNone) value = static_cast<float>(v);
        };
        if (painting) {
            row({.label = "Size",
                 .unit = "px",
                 .tip = "Radius of the brush. [ and ]",
                 .min = 1,
                 .max = 400,
                 .standard = 24,
                 .decimals = 0,
                 .logarithmic = true,
                 .typed_min = 0.5,
                 .typed_max = 2000},
                b.radius_px);
            row({.label = "Hardness",
                 .tip = "1: a hard edge. Shift+[ and Shift+]",
                 .standard = 0.8},
                b.hardness);
            row({.label = "Opacity", .tip = "Of the whole stroke", .standard = 1}, b.opacity);
            quiet(c, "Alt subtracts, Shift draws a line");
        } else if (c.state.tool == Tool::kFlood) {
            double tolerance = c.state.brush.tolerance;
            if (slider(c,
                       {.label = "Tolerance",
                        .tip = "How far a colour may be from the one clicked",
                        .min = 0,
                        .max = 128,
                        .standard = 24,
                        .decimals = 0,
                        .integer = true},
                       tolerance) != Change::kNone)
                c.state.brush.tolerance = static_cast<int>(tolerance);
            quiet(c, "Click a colour; Alt takes it away");
        } else if (c.state.tool == Tool::kPolygon) {
            quiet(c, "Click corners; Enter closes, Esc drops");
        } else if (c.state.tool == Tool::kShape) {
            shape_controls(c);
        } else if (c.state.tool == Tool::kScribble) {
            quiet(c, "Draw inside the surface; Alt: outside");
            const ScribbleState& s = c.state.scribbles;
            if (button(c, "Forget the lines",
                       {.icon = icons::kClose,
                        .enabled = !s.keep.empty() || !s.drop.empty(),
                        .tip = "The matte stays as it is. Esc",
                        .width = -1}))
                c.state.scribbles = {};
        } else if (c.state.tool == Tool::kLasso) {
            quiet(c, "Draw around the surface; Alt cuts out");
        } else {
            quiet(c, "Drag to move the picture");
        }
        section_gap(c);
    }
    if (section(c, "Matte")) {
        const PanelName panel(c, "Matte");
        matte_source_card(c, *region);
        section_gap(c);
    }
    if (region->matte->files.empty() && section(c, "Edge")) {
        const PanelName panel(c, "Edge");
        const bool enabled = !c.view.matte_busy && !region->matte->empty();
        const float third = std::floor((ImGui::GetContentRegionAvail().x - 2 * t.gap) / 3);
        if (button(
                c, "Grow",
                {.enabled = enabled, .tip = "By 1 px on this frame; Shift 5 px", .width = third}))
            c.emit(GrowMatte{ImGui::GetIO().KeyShift ? 5.0f : 1.0f});
        ImGui::SameLine();
        if (button(
                c, "Shrink",
                {.enabled = enabled, .tip = "By 1 px on this frame; Shift 5 px", .width = third}))
            c.emit(GrowMatte{ImGui::GetIO().KeyShift ? -5.0f : -1.0f});
        ImGui::SameLine();
        if (button(c, "Feather",
                   {.enabled = enabled,
                    .tip = "Softens the edge by 2 px on this frame",
                    .width = third}))
            c.emit(FeatherMatte{2});
        section_gap(c);
    }
    if (section(c, "Other frames")) {
        const PanelName panel(c, "Propagation");
        const SessionView& v = c.view;
        if (region->matte->keyframes.empty()) {
            wrapped(c,
                    region->matte->files.empty()
                        ? "What you paint is carried to the other frames by itself."
                        : "The files have a matte for every frame.",
                    c.theme.quiet);
        } else if (v.preview.analysing) {
            const float part = v.preview.total > 0 ? static_cast<float>(v.preview.done) /
                                                         static_cast<float>(v.preview.total)
                                                   : 0;
            progress_bar(c, part,
                         "Carrying the matte, " + std::to_string(v.preview.done) + " of " +
                             std::to_string(v.preview.total));
            if (button(c, "Pause", {.icon = icons::kPause, .width = -1}))
                c.emit(PauseAnalysis{true});
        } else if (v.analysis_paused) {
            if (button(c, "Continue", {.icon = icons::kPlay, .look = Look::kPrimary, .width = -1}))
                c.emit(PauseAnalysis{false});
        } else if (v.unready.contains(region->id)) {
            wrapped(c, "Choose a texture, and the matte is carried through the shot.",
                    c.theme.quiet);
        } else {
            wrapped(c,
                    "Carried through the shot. The strip below the ruler is light where it is "
                    "unsure.",
                    c.theme.quiet);
        }
        section_gap(c);
    }
}

void texture_inspector(Ctx& c) {
    const Region* region = c.view.selected_region();
    if (!region) return no_region(c);
    const Theme& t = c.theme;
    if (section(c, "Texture")) {
        const PanelName panel(c, "Texture");
        const bool plane = !region->texture.plane.empty();
        const std::string& path = plane ? region->texture.plane : region->texture.sample;
        if (path.empty()) {
            banner(c, icons::kTexture, t.accent,
                   "Double-click a texture in the drawer below, or drag one onto the surface.");
        } else {
            const PicturePtr thumb = c.textures.thumbnail(
                path.starts_with('/')
                    ? path
                    : c.view.path.substr(0, c.view.path.find_last_of('/') + 1) + path,
                static_cast<int>(t.px(96)));
            const ImVec2 at = ImGui::GetCursorScreenPos();
            const float side = t.px(64);
            ImDrawList& list = *ImGui::GetWindowDrawList();
            list.AddRectFilled(at, {at.x + side, at.y + side}, t.field, t.radius);
            if (thumb)
                if (const ImTextureID id = c.pictures.texture(thumb))
                    list.AddImageRounded(id, at, {at.x + side, at.y + side}, {0, 0}, {1, 1},
                                         IM_COL32_WHITE, t.radius);
            const std::size_t slash = path.find_last_of('/');
            const float x = at.x + side + t.px(10);
            const float right = at.x + ImGui::GetContentRegionAvail().x;
            text_in(
                list, t.strong, {x, at.y + t.px(4)}, {right, at.y + t.px(24)}, t.text,
                fitted(path.substr(slash == std::string::npos ? 0 : slash + 1), right - x).c_str(),
                0);
            text_in(list, t.small, {x, at.y + t.px(24)}, {right, at.y + t.px(42)}, t.quiet,
                    plane ? "Used as it is" : "Grown over the surface", 0);
            ImGui::Dummy({side, side});
            const bool as_plane = plane;
            int how = as_plane ? 1 : 0;
            if (segments(c, "How", {"Grow it", "Use as it is"}, how)) {
                TextureSource source = region->texture;
                source.sample = how == 0 ? path : "";
                source.plane = how == 1 ? path : "";
                const std::string keep = path;
                if (how == 0) source.sample = keep;
                c.edit(SetTexture{{region->id, {}}, source});
            }
            if (plane) region_parameter(c, *region, "texture.wrap", "Beyond its edge");
        }
        section_gap(c);
    }
    if (section(c, "Placement")) {
        const PanelName panel(c, "Placement");
        region_parameter(c, *region, "placement.scale");
        region_parameter(c, *region, "placement.rotate_deg");
        region_parameter(c, *region, "placement.offset_px", "Offset");
        if (button(c, "Place by hand",
                   {.icon = icons::kMove,
                    .tip = "Drag on the picture to move the texture, with Shift to turn it, with "
                           "Ctrl to scale it",
                    .command = "tool.place",
                    .width = -1}))
            c.state.tool = Tool::kPlace;
        section_gap(c);
    }
    provenance_section(c, *region);
    if (section(c, "Perspective", false)) {
        const PanelName panel(c, "Perspective");
        region_parameter(c, *region, "placement.corners_px", "Corners");
        const bool set = region->placement.corners_px.has_value();
        const Size plate = c.view.plate.size;
        if (!set && button(c, "Set four corners",
                           {.icon = icons::kCrosshairs,
                            .enabled = !plate.empty(),
                            .tip = "Puts four corners on the picture to be dragged to a flat "
                                   "surface in perspective",
                            .width = -1})) {
            const double w = plate.width, h = plate.height;
            c.edit(SetRegionParameter{{region->id, {}},
                                      "placement.corners_px",
                                      std::vector<double>{0.3 * w, 0.3 * h, 0.7 * w, 0.3 * h,
                                                          0.7 * w, 0.7 * h, 0.3 * w, 0.7 * h}});
            c.state.tool = Tool::kPlace;
        }
        if (set && button(c, "Remove the corners", {.icon = icons::kClose, .width = -1}))
            c.edit(SetRegionParameter{{region->id, {}}, "placement.corners_px", {}});
        section_gap(c);
    }
}

void motion_inspector(Ctx& c) {
    const Region* region = c.view.selected_region();
    if (!region) return no_region(c);
    const Theme& t = c.theme;
    const SessionView& v = c.view;
    if (section(c, "Reference frames")) {
        const PanelName panel(c, "Reference frames");
        if (region->reference_frames.empty())
            wrapped(c, "The texture lies where you place it on the first frame with a matte.",
                    t.quiet);
        for (const int frame : region->reference_frames) {
            ImGui::PushID(frame);
            if (button(c, ("Frame " + std::to_string(frame)).c_str(),
                       {.icon = icons::kReference,
                        .look = frame == v.frame ? Look::kNormal : Look::kQuiet}))
                c.emit(GoToFrame{frame});
            ImGui::SameLine();
            if (icon_button(c, icons::kClose, ("Remove " + std::to_string(frame)).c_str(), false,
                            nullptr, true, t.row)) {
                std::vector<double> left;
                for (const int f : region->reference_frames)
                    if (f != frame) left.push_back(f);
                c.edit(SetRegionParameter{{region->id, {}}, "reference_frames", left});
            }
            ImGui::PopID();
        }
        const bool here =
            std::find(region->reference_frames.begin(), region->reference_frames.end(), v.frame) !=
            region->reference_frames.end();
        if (button(c, "Add this frame",
                   {.icon = icons::kPlus,
                    .enabled = !here,
                    .tip = "The surface is followed from here in both directions; between two "
                           "references the histories blend",
                    .width = -1})) {
            std::vector<double> frames(region->reference_frames.begin(),
                                       region->reference_frames.end());
            frames.push_back(v.frame);
            c.edit(SetRegionParameter{{region->id, {}}, "reference_frames", frames});
        }
        section_gap(c);
    }
    corrections_section(c, *region);
    if (section(c, "Motion")) {
        const PanelName panel(c, "Motion");
        if (region->motion.files.empty()) {
            info_row(c, "From", "Estimated from the plate");
            if (button(c, "Use motion files…",
                       {.icon = icons::kFolderImage,
                        .tip = "True motion from a render: .flo or KITTI 16-bit PNG",
                        .width = -1})) {
                c.state.browser.purpose = BrowserState::Purpose::kMotion;
                c.state.browser.just_opened = true;
            }
        } else {
            info_row(c, "Files", region->motion.files);
            region_parameter(c, *region, "motion.direction", "They point");
            if (button(c, "Estimate it instead", {.icon = icons::kRefresh, .width = -1}))
                c.edit(SetRegionParameter{{region->id, {}}, "motion.files", std::string()});
        }
        section_gap(c);
    }
    if (section(c, "Look at")) {
        const PanelName panel(c, "Look at");
        for (const char* id : {"view.grid", "view.stretch", "view.arrows", "view.trust"}) {
            const Command* command = c.commands.find(id);
            bool on = command->checked(c);
            if (checkbox(c, command->name.c_str(), on)) command->run(c);
        }
        section_gap(c);
    }
    if (section(c, "Through time")) {
        const PanelName panel(c, "Time");
        region_parameter(c, *region, "temporal.mode", "The texture is");
        if (region->temporal.mode == TemporalMode::kPaper) {
            region_parameter(c, *region, "temporal.blend");
            region_parameter(c, *region, "temporal.weight");
        }
        section_gap(c);
    }
}

void light_inspector(Ctx& c) {
    const Region* region = c.view.selected_region();
    if (!region) return no_region(c);
    const Theme& t = c.theme;
    if (section(c, "Light")) {
        const PanelName panel(c, "Light");
        region_parameter(c, *region, "light.source", "Light");
        if (region->light.source == LightSource::kImage)
            region_parameter(c, *region, "light.image", "Picture");
        if (region->light.source == LightSource::kPainted) lamps_controls(c, *region);
        if (region->light.source != LightSource::kNone) {
            region_parameter(c, *region, "light.strength");
            region_parameter(c, *region, "light.form", "Put on as");
        }
        const Command* over = c.commands.find("view.light");
        bool on = over->checked(c);
        if (checkbox(c, "Show the light", on, "What the plate's light does to the surface"))
            over->run(c);
        section_gap(c);
    }
    if (section(c, "Seams")) {
        const PanelName panel(c, "Seams");
        const bool grown = region->texture.plane.empty();
        if (!grown) {
            wrapped(c, "This texture is used as it is, so it has no seams.", t.quiet);
        } else {
            region_parameter(c, *region, "synthesis.seam", "Cut");
            region_parameter(c, *region, "synthesis.overlap_px");
            region_parameter(c, *region, "synthesis.feather_px");
            region_parameter(c, *region, "synthesis.refine");
            region_parameter(c, *region, "synthesis.rotations", "Turned pieces");
            region_parameter(c, *region, "synthesis.mirror", "Mirrored pieces");
            region_parameter(c, *region, "synthesis.align", "Keep courses in step");
            region_parameter(c, *region, "synthesis.seam_cost", "Seam follows");
            region_parameter(c, *region, "texture.also", "Further samples");
            project_parameter(c, "settings.seed", "Variation");
            const Command* over = c.commands.find("view.seams");
            bool on = over->checked(c);
            if (checkbox(c, "Show the seams", on,
                         "Where pieces of the sample meet, by how much they differ"))
                over->run(c);
        }
        section_gap(c);
    }
    if (section(c, "Through time")) {
        const PanelName panel(c, "Time");
        region_parameter(c, *region, "temporal.mode", "The texture is");
        if (region->temporal.mode == TemporalMode::kPaper) {
            region_parameter(c, *region, "temporal.blend");
            region_parameter(c, *region, "temporal.weight");
        }
        section_gap(c);
    }
    if (section(c, "Preview")) {
        const PanelName panel(c, "Preview");
        int quality = c.view.preview_quality == Quality::kDraft ? 0 : 1;
        if (segments(c, "Quality", {"Draft", "Final"}, quality))
            c.emit(SetPreviewQuality{quality == 0 ? Quality::kDraft : Quality::kFinal});
        if (c.view.preview.frame_seconds > 0)
            info_row(c, "Last frame took", number_text(c.view.preview.frame_seconds, 2) + " s");
        section_gap(c);
    }
}

void inspector(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    begin_panel(c, "Inspector", size, t.panel, true, t.px(10));
    if (!c.view.open) {
        empty_state(c, icons::kLayers, "Nothing open", "Open a shot to see its regions here.");
        end_panel(c);
        return;
    }
    region_list(c);
    ImGui::Dummy({0, t.px(4)});
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
    end_panel(c);
}

}  // namespace weft::ui

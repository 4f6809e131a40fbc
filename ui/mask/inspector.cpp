// The inspector of the Mask workspace: tools and mattes.
#include <algorithm>
#include <cmath>

#include "app/mattes/matte_layer.h"
#include "ui/base/icons.h"
#include "ui/mask/mask.h"
#include "ui/mask/sections.h"
#include "ui/parameters/parameters.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

// Which layer the brush is on, where it is not the matte itself.
void layer_banner(Ctx& c) {
    const Theme& t = c.theme;
    if (c.view.matte_layer > 0)
        banner(c, icons::kLayers, t.warn,
               "You are painting a holdout, layer " + std::to_string(c.view.matte_layer) +
                   ". It is cut out of the region's matte.");
    if (is_zone_layer(c.view.matte_layer))
        banner(c, icons::kLayers, t.warn,
               "You are painting light zone " +
                   std::to_string(zone_of_layer(c.view.matte_layer) + 1) +
                   ". The region's matte stays as it is.");
}

void shape_card(Ctx& c, const KeyedShape& shape) {
    const std::size_t keys = shape.keys.size();
    info_row(c, "Roto shape", std::to_string(keys) + (keys == 1 ? " key" : " keys"),
             "Drawn on every frame; edit it with the roto shape tool (N)");
    if (c.state.tool != Tool::kShape &&
        button(c, "Edit shape", {.icon = icons::kCurve, .command = "tool.shape", .width = -1}))
        c.commands.run("tool.shape", c);
}

void keyframe_rows(Ctx& c, const Region& region, const MatteSource& matte) {
    // In one row, so that nothing below it moves with the first correction.
    const std::size_t parts = matte.confirmed.size();
    const std::string keys = std::to_string(matte.keyframes.size()) +
                             (parts > 0 ? ", " + std::to_string(parts) + " in part" : "");
    info_row(c, "Keyframes", keys,
             parts > 0 ? "In part: frames on which parts of the matte are confirmed or corrected"
                       : nullptr);
    const float half = std::floor((ImGui::GetContentRegionAvail().x - c.theme.gap) * 0.5f);
    const bool key_here = matte.keyframes.contains(c.view.frame);
    const bool part_here = !key_here && matte.confirmed.contains(c.view.frame);
    if (button(c, "Add keyframe",
               {.enabled = !key_here,
                .tip = "Makes this frame's matte a keyframe that you can correct",
                .command = "region.key",
                .width = half}))
        c.emit(KeyMatteHere{});
    ImGui::SameLine();
    if (button(c, part_here ? "Remove confirmed###remove_key" : "Remove keyframe###remove_key",
               {.enabled = key_here || part_here,
                .tip = "Propagates the neighbouring keyframes to this frame again",
                .width = half}))
        c.edit(without_layer_key(region, c.view.matte_layer, c.view.frame));
    auto before = matte.keyframes.lower_bound(c.view.frame);
    const bool can_copy = before != matte.keyframes.begin() && !key_here;
    if (button(c, "Copy previous keyframe",
               {.icon = icons::kCopy,
                .enabled = can_copy,
                .tip = "Copies the nearest earlier keyframe's matte to this frame",
                .width = -1}))
        c.emit(CopyKeyframe{std::prev(before)->first, c.view.frame});
}

void matte_source_card(Ctx& c, const Region& region) {
    const Theme& t = c.theme;
    const MatteSource matte = c.view.painted_source();
    layer_banner(c);
    if (!matte.shape.empty()) return shape_card(c, matte.shape);
    if (!matte.files.empty() || !matte.select.crypto.empty()) {
        if (!matte.select.crypto.empty())
            info_row(c, "Cryptomatte", matte.select.crypto, matte.select.crypto.c_str());
        else
            info_row(c, "Matte files", matte.files);
        if (button(
                c, "Paint instead",
                {.icon = icons::kBrush,
                 .enabled = c.view.plate.state == PlateView::State::kOpen,
                 .tip = "Turns this frame's matte into a painted keyframe, which is propagated to "
                        "the other frames",
                 .width = -1}))
            c.emit(PaintInstead{});
        return;
    }
    if (matte.keyframes.empty() && c.view.matte_layer != 0) {
        wrapped(c, "One frame is enough to start; it is propagated to the others.", t.quiet);
        return;
    }
    if (matte.keyframes.empty()) {
        banner(c, icons::kBrush, t.accent,
               "Paint over the surface with the brush (B). One frame is enough to start; it "
               "is propagated to the others.");
        ImGui::Dummy({0, t.px(2)});
        if (button(c, "Use matte files…",
                   {.icon = icons::kFolderImage,
                    .tip = "A matte for every frame, from an image sequence",
                    .width = -1})) {
            c.state.browser.purpose = BrowserState::Purpose::kMatte;
            c.state.browser.just_opened = true;
        }
        return;
    }
    keyframe_rows(c, region, matte);
}

// What pen pressure controls.
void pressure_row(Ctx& c, Brush& brush) {
    int which = (brush.pressure_size ? 1 : 0) + (brush.pressure_opacity ? 2 : 0);
    if (!choice(c, "Pen pressure", {"Nothing", "Size", "Opacity", "Both"}, which,
                "What the pressure of a tablet's pen controls", 1))
        return;
    brush.pressure_size = which == 1 || which == 3;
    brush.pressure_opacity = which >= 2;
}

void files_section(Ctx& c, const Region& region) {
    if (region.matte->empty() || !section(c, "Freeze and export", false)) return;
    const PanelName panel(c, "Matte files");
    const bool marked = c.view.mark_in || c.view.mark_out;
    quiet(c, marked ? "Freeze marked range" : "Freeze whole shot");
    if (!region.matte->by_frame()) {
        if (region.matte->frozen.empty()) {
            if (button(c, "Freeze",
                       {.icon = icons::kLock,
                        .tip = "Keeps the mattes of these frames as they are now, "
                               "whatever you paint on other frames",
                        .width = -1}))
                c.emit(FreezeMattes{true});
        } else if (button(c,
                          ("Unfreeze " + std::to_string(region.matte->frozen.size()) +
                           " frames##freeze")
                              .c_str(),
                          {.icon = icons::kLockOpen, .width = -1})) {
            c.emit(FreezeMattes{false});
        }
        region_parameter(c, region, "matte.steadiness", "Stabilize edge");
    }
    if (button(
            c, "Export mattes…",
            {.icon = icons::kExport, .tip = "Writes PNG files for other programs", .width = -1})) {
        c.state.browser.purpose = BrowserState::Purpose::kExportMattes;
        c.state.browser.just_opened = true;
    }
    section_gap(c);
}

// How the matte is shown over the plate.
void overlay_section(Ctx& c, const Region& region) {
    if (!section(c, "Overlay", false)) return;
    const PanelName panel(c, "Matte overlay");
    const Theme& t = c.theme;
    slider(c,
           {.label = "Opacity",
            .tip = "Of the matte's colour over the plate. The outline stays",
            .min = 0,
            .max = 1,
            .standard = EditorSettings{}.matte_opacity},
           c.settings.matte_opacity);
    quiet(c, "Colour");
    constexpr int kColors = 7;
    const ImU32 now = region_color(region.color, region.id);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (int k = 1; k <= kColors; ++k) {
        if (k > 1) ImGui::SameLine(0, t.px(6));
        ImGui::PushID(k);
        const bool pressed = ImGui::InvisibleButton("##color", {t.px(26), t.px(24)});
        ImGui::PopID();
        c.note("Colour " + std::to_string(k));
        const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
        list.AddRectFilled(min, max, region_color(k), t.radius);
        if (region_color(k) == now) list.AddRect(min, max, t.text, t.radius, 0, t.px(2));
        if (pressed) c.edit(SetRegionParameter{{region.id, {}}, "color", static_cast<double>(k)});
    }
    bool onion = c.view.onion_skin;
    if (checkbox(c, "Onion skin", onion, "The keyframes before (blue) and after (amber) the frame"))
        c.emit(ShowOnionSkin{onion});
    section_gap(c);
}

// The edge tools of the matte that is edited, over all frames.
void edge_section(Ctx& c, const Region& region, const MatteSource& matte) {
    if (matte.empty() || !section(c, "Edge")) return;
    const PanelName panel(c, "Edge");
    matte_parameter(c, region, "matte.choke_px", "matte.choke_keys");
    matte_parameter(c, region, "matte.feather_px", "matte.feather_keys");
    matte_parameter(c, region, "matte.blur_px", "matte.blur_keys");
    section_gap(c);
}

void clean_up_section(Ctx& c, const Region& region, const MatteSource& matte) {
    if (matte.empty() || !section(c, "Clean up", false)) return;
    const PanelName panel(c, "Clean up");
    matte_parameter(c, region, "matte.smooth_px");
    matte_parameter(c, region, "matte.min_island_px");
    matte_parameter(c, region, "matte.min_hole_px");
    section_gap(c);
}

// The same once, on the painted keyframe, which is propagated then.
void painted_edge_section(Ctx& c, const MatteSource& matte) {
    if (!matte.files.empty() || !matte.select.crypto.empty() ||
        !section(c, "Painted edge, this frame", false))
        return;
    const PanelName panel(c, "Painted edge");
    const bool enabled = !c.view.matte_busy && !matte.empty();
    const float third = std::floor((ImGui::GetContentRegionAvail().x - 2 * c.theme.gap) / 3);
    const float px = ImGui::GetIO().KeyShift ? 5.0f : 1.0f;
    if (button(c, "Grow",
               {.enabled = enabled,
                .tip = "Paints the matte of this frame 1 px larger and propagates it; with Shift "
                       "5 px",
                .width = third}))
        c.emit(GrowMatte{px});
    ImGui::SameLine();
    if (button(c, "Shrink",
               {.enabled = enabled,
                .tip = "Paints the matte of this frame 1 px smaller and propagates it; with Shift "
                       "5 px",
                .width = third}))
        c.emit(GrowMatte{-px});
    ImGui::SameLine();
    if (button(c, "Feather",
               {.enabled = enabled,
                .tip = "Paints the edge of this frame 2 px softer and propagates it",
                .width = third}))
        c.emit(FeatherMatte{2});
    section_gap(c);
}

void brush_row(Ctx& c, const SliderSpec& spec, float& value) {
    double v = static_cast<double>(value);
    if (slider(c, spec, v) != Change::kNone) value = static_cast<float>(v);
}

void size_row(Ctx& c, Brush& brush) {
    brush_row(c,
              {.label = "Size",
               .unit = "px",
               .tip = "Brush radius. [ and ]",
               .min = 1,
               .max = 400,
               .standard = 24,
               .decimals = 0,
               .logarithmic = true,
               .typed_min = kLeastBrush_px,
               .typed_max = 2000},
              brush.radius_px);
}

// Whether the tool changes the matte of a frame in part.
bool corrects(Tool tool) {
    constexpr Tool kAll[] = {Tool::kBrush,   Tool::kEraser, Tool::kLasso,
                             Tool::kPolygon, Tool::kFlood,  Tool::kScribble};
    return std::find(std::begin(kAll), std::end(kAll), tool) != std::end(kAll);
}

void confirm_rows(Ctx& c) {
    size_row(c, c.state.brush.brush);
    wrapped(c,
            "Paint along the edge where it is right on this frame. It is kept there and propagated "
            "from there; the rest stays as it is. Ctrl takes the mark away.",
            c.theme.quiet);
}

}  // namespace

void brush_rows(Ctx& c) {
    Brush& b = c.state.brush.brush;
    size_row(c, b);
    brush_row(
        c, {.label = "Hardness", .tip = "1 is a hard edge. Shift+[ and Shift+]", .standard = 0.8},
        b.hardness);
    brush_row(c, {.label = "Opacity", .tip = "Opacity of the whole stroke", .standard = 1},
              b.opacity);
    pressure_row(c, b);
    quiet(c, "Ctrl subtracts, Shift draws a line");
}

void mask_inspector(Ctx& c) {
    const Region* region = c.view.selected_region();
    if (!region) return no_region(c);
    const Theme& t = c.theme;
    const bool painting = paints(c.state.tool);
    if (section(c, c.state.tool == Tool::kConfirm ? "Confirm edge"
                   : painting                     ? "Brush"
                   : c.state.tool == Tool::kFlood ? "Select by colour"
                   : c.state.tool == Tool::kShape ? "Shape"
                                                  : "Tool")) {
        const PanelName panel(c, "Brush");
        if (c.state.tool == Tool::kConfirm) {
            confirm_rows(c);
        } else if (painting) {
            brush_rows(c);
        } else if (c.state.tool == Tool::kFlood) {
            double tolerance = c.state.brush.tolerance;
            if (slider(c,
                       {.label = "Tolerance",
                        .tip = "How much a colour may differ from the one you click",
                        .min = 0,
                        .max = 128,
                        .standard = 24,
                        .decimals = 0,
                        .integer = true},
                       tolerance) != Change::kNone)
                c.state.brush.tolerance = static_cast<int>(tolerance);
            quiet(c, "Click a colour to add it; Ctrl subtracts");
        } else if (c.state.tool == Tool::kCrypto) {
            wrapped(c, "Click an object of the plate's Cryptomatte to add it; Ctrl subtracts.",
                    t.quiet);
            if (const std::string names = c.view.painted_source().select.crypto; !names.empty())
                info_row(c, "Objects", names, names.c_str());
        } else if (c.state.tool == Tool::kPolygon) {
            quiet(c, "Click corners; Enter closes, Esc cancels");
        } else if (c.state.tool == Tool::kShape) {
            shape_controls(c);
        } else if (c.state.tool == Tool::kScribble) {
            quiet(c, "Draw inside the surface; Ctrl draws outside");
            const ScribbleState& s = c.state.scribbles;
            if (button(c, "Clear scribbles",
                       {.icon = icons::kClose,
                        .enabled = !s.lines.empty(),
                        .tip = "The matte stays as it is. Esc",
                        .width = -1}))
                c.state.scribbles.lines.clear();
        } else if (c.state.tool == Tool::kLasso) {
            quiet(c, "Draw around the surface; Ctrl subtracts");
        } else {
            quiet(c, "Drag to pan the viewer");
        }
        if (corrects(c.state.tool))
            checkbox(c, "Correct only where painted", c.settings.here_only,
                     "On frames to which the matte is propagated, what you change counts there "
                     "only, and the rest is propagated as before. Off: the whole frame becomes a "
                     "keyframe");
        section_gap(c);
    }
    if (section(c, "Matte")) {
        const PanelName panel(c, "Matte");
        matte_source_card(c, *region);
        section_gap(c);
    }
    const MatteSource painted = c.view.painted_source();
    edge_section(c, *region, painted);
    clean_up_section(c, *region, painted);
    holdouts_section(c, *region);
    light_zones_section(c, *region);
    propagation_section(c, *region);
    painted_edge_section(c, painted);
    if (!painted.keyframes.empty()) hints_section(c, true);
    files_section(c, *region);
    overlay_section(c, *region);
}

}  // namespace weft::ui

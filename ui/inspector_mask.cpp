// The inspector of the Mask workspace: tools, mattes and what stands in front.
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

// What passes in front of the surface: it is cut out of the matte, and the surface comes back
// behind it with the texture that it had.
void holdouts_section(Ctx& c, const Region& region) {
    if (!section(c, "In front of it", !region.holdouts->empty())) return;
    const PanelName panel(c, "Holdouts");
    if (region.holdouts->empty())
        wrapped(c,
                "Mattes of what passes in front are cut out; the surface comes back behind them.",
                c.theme.quiet);
    for (std::size_t k = 0; k < region.holdouts->size(); ++k) {
        const MatteSource& holdout = (*region.holdouts)[k];
        ImGui::PushID(static_cast<int>(k));
        const std::size_t slash = holdout.files.find_last_of('/');
        info_row(c, ("Layer " + std::to_string(k + 1)).c_str(),
                 holdout.files.substr(slash == std::string::npos ? 0 : slash + 1),
                 holdout.files.c_str());
        if (button(c, ("Remove layer " + std::to_string(k + 1)).c_str(),
                   {.icon = icons::kClose, .look = Look::kQuiet, .width = -1})) {
            std::vector<MatteSource> left = *region.holdouts;
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
            c.edit(SetHoldouts{{region.id, {}}, left});
        }
        ImGui::PopID();
    }
    // Another region's matte serves as well: paint it there.
    for (const Leaf<Region>& other : c.view.project.regions) {
        if (other->id == region.id || other->matte->files.empty()) continue;
        const auto& list = *region.holdouts;
        const bool has = std::any_of(list.begin(), list.end(), [&](const MatteSource& m) {
            return m.files == other->matte->files;
        });
        if (!has && button(c, ("Cut out " + other->name).c_str(),
                           {.icon = icons::kMinus,
                            .tip = "That region's matte is cut out of this one",
                            .width = -1})) {
            std::vector<MatteSource> more = list;
            more.push_back(*other->matte);
            c.edit(SetHoldouts{{region.id, {}}, more});
        }
    }
    if (button(c, "Add matte files…##holdout", {.icon = icons::kFolderImage, .width = -1})) {
        c.state.browser.purpose = BrowserState::Purpose::kHoldout;
        c.state.browser.just_opened = true;
    }
    section_gap(c);
}

void files_section(Ctx& c, const Region& region) {
    if (region.matte->empty() || !section(c, "Keep and export", false)) return;
    const PanelName panel(c, "Matte files");
    const bool marked = c.view.mark_in || c.view.mark_out;
    quiet(c, marked ? "Of the marked range" : "Of the whole shot");
    if (region.matte->files.empty()) {
        if (region.matte->frozen.empty()) {
            if (button(c, "Freeze",
                       {.icon = icons::kLock,
                        .tip = "These frames keep their mattes as they are now, "
                               "whatever is painted elsewhere",
                        .width = -1}))
                c.emit(FreezeMattes{true});
        } else if (button(c,
                          ("Let " + std::to_string(region.matte->frozen.size()) +
                           " frames follow again##freeze")
                              .c_str(),
                          {.icon = icons::kLockOpen, .width = -1})) {
            c.emit(FreezeMattes{false});
        }
        region_parameter(c, region, "matte.steadiness", "Steadiness");
    }
    if (button(c, "Export mattes…",
               {.icon = icons::kExport, .tip = "As PNG files, for other programs", .width = -1})) {
        c.state.browser.purpose = BrowserState::Purpose::kExportMattes;
        c.state.browser.just_opened = true;
    }
    section_gap(c);
}

}  // namespace

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
    holdouts_section(c, *region);
    files_section(c, *region);
}

}  // namespace weft::ui

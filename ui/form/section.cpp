// Texture workspace: the form of the surface, and what draws it.
#include <algorithm>

#include "ui/base/icons.h"
#include "ui/form/drawing.h"
#include "ui/form/form.h"
#include "ui/parameters/parameters.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

double most_amount(const Region& region) {
    double most = region.form.amount_keys.empty() ? region.form.amount : 0;
    for (const NumberKey& key : region.form.amount_keys.keys)
        most = std::max(most, key.numbers[0]);
    return most;
}

constexpr FormGuideKind kFormShapes[] = {FormGuideKind::kPlane, FormGuideKind::kCylinder,
                                         FormGuideKind::kCone, FormGuideKind::kBall};
constexpr FormGuideKind kStrokes[] = {FormGuideKind::kLevel, FormGuideKind::kParallel,
                                      FormGuideKind::kCut};

// What was found, once the analysis is there.
std::string finding(const Ctx& c, const Region& region) {
    const auto found = c.view.preview.forms.find(region.id);
    const auto& pinned = c.state.form.pinned_on;
    const bool off = region.form.source == FormSource::kFlat || most_amount(region) <= 0;
    if (off) return "Flat";
    if (region.placement.corners_px && pinned.contains(region.id))
        return "The corner pin gives the perspective. It began on: " + pinned.at(region.id);
    if (found != c.view.preview.forms.end()) return found->second;
    if (region.form.source == FormSource::kPass && region.form.position.empty() &&
        region.form.normal.empty())
        return "No position or normal pass: flat";
    return region.placement.corners_px ? "The corner pin gives the perspective" : "Not found yet";
}

template <std::size_t Count>
void kind_buttons(Ctx& c, const char* name, const std::vector<const char*>& labels,
                  const FormGuideKind (&kinds)[Count]) {
    FormToolState& s = c.state.form;
    int value = -1;
    for (std::size_t k = 0; k < Count; ++k)
        if (c.state.tool == Tool::kForm && s.kind == kinds[k]) value = static_cast<int>(k);
    if (!segments(c, name, labels, value)) return;
    s.kind = kinds[static_cast<std::size_t>(value)];
    s.from.reset();
    c.state.tool = Tool::kForm;
    if (const auto reference = reference_of(c, *c.view.selected_region());
        reference && *reference != c.view.frame)
        c.emit(GoToFrame{*reference});
}

const char* how_to(FormGuideKind kind) {
    switch (kind) {
        case FormGuideKind::kPlane:
            return "Drag across the surface, then drag the corners onto what is a rectangle on "
                   "it.";
        case FormGuideKind::kCylinder:
        case FormGuideKind::kCone:
            return "Drag along the axis, then drag the hollow handles to the outline.";
        case FormGuideKind::kBall:
            return "Drag from the centre to the outline.";
        case FormGuideKind::kLevel:
            return "Drag along what is level: the rows of the texture follow it.";
        case FormGuideKind::kParallel:
            return "Drag along two or more lines that are parallel on the surface. Lines across "
                   "them are taken to be at right angles.";
        case FormGuideKind::kCut:
            return "Drag along an outline where the surface does not turn away but is cut off.";
    }
    return "";
}

// The tilt of a cylinder or cone, which its outlines give unless it is set.
void tilt_controls(Ctx& c, const Region& region) {
    if (region.form.shape.empty()) return;
    FormGuide shape = region.form.shape.front();
    if (shape.kind != FormGuideKind::kCylinder && shape.kind != FormGuideKind::kCone) return;
    const auto set = [&](bool done) {
        const SetRegionParameter edit{{region.id, {}}, "form.shape", std::vector<FormGuide>{shape}};
        if (done)
            c.edit(edit);
        else
            c.emit(TryEdit{edit});
    };
    bool found = shape.numbers.size() < 7;
    if (checkbox(c, "Tilt from outline", found,
                 "The two sides of the shape tell how far its axis is tilted")) {
        shape.numbers.resize(found ? 6 : 7);
        set(true);
        return;
    }
    if (found) return;
    const Change change = slider(c,
                                 {.label = "Tilt",
                                  .unit = "°",
                                  .tip = "Above 0 where the end of the axis is farther away than "
                                         "its start",
                                  .min = -80,
                                  .max = 80,
                                  .decimals = 0},
                                 shape.numbers[6]);
    if (change != Change::kNone) set(change == Change::kDone);
}

void overlay_buttons(Ctx& c) {
    constexpr Overlay kOverlays[] = {Overlay::kNone, Overlay::kChecker, Overlay::kCircles,
                                     Overlay::kNormals};
    int shown = 0;
    for (int k = 1; k < 4; ++k)
        if (c.view.overlay == kOverlays[k]) shown = k;
    if (segments(c, "Shown", {"None", "Checker", "Circles", "Normals"}, shown))
        c.emit(ShowOverlay{kOverlays[shown]});
}

}  // namespace

std::optional<int> reference_of(const Ctx& c, const Region& region) {
    if (!region.reference_frames.empty()) return region.reference_frames.front();
    const auto chosen = c.view.preview.references.find(region.id);
    if (chosen == c.view.preview.references.end()) return std::nullopt;
    return chosen->second;
}

void form_section(Ctx& c, const Region& region) {
    if (!section(c, "Form")) return;
    const PanelName panel(c, "Form");
    region_parameter(c, region, "form.source", "Source");
    if (region.form.source == FormSource::kInflate) region_parameter(c, region, "form.roundness");
    keyed_parameter(c, region, "form.amount", "form.amount_keys");
    if (const auto why = c.view.form_problems.find(region.id); why != c.view.form_problems.end())
        banner(c, icons::kAlert, c.theme.bad, why->second);
    else
        // It changes when the analysis is there; the buttons below stay where they are.
        wrapped_in(c, finding(c, region), c.theme.quiet, 2);
    kind_buttons(c, "Shapes", {"Plane", "Cylinder", "Cone", "Ball"}, kFormShapes);
    kind_buttons(c, "Strokes", {"Level", "Parallel", "Cut"}, kStrokes);
    const FormParams& form = region.form;
    if (c.state.tool == Tool::kForm) {
        const auto reference = reference_of(c, region);
        if (reference && *reference != c.view.frame) {
            const std::string label = "Go to reference frame " + std::to_string(*reference);
            if (button(c, label.c_str(),
                       {.icon = icons::kReference,
                        .tip = "Shapes and strokes lie on the reference frame",
                        .width = -1}))
                c.emit(GoToFrame{*reference});
        } else if (c.state.form.parallel && c.state.form.region == region.id) {
            wrapped(c, "Draw a second line that is parallel to the first on the surface.",
                    c.theme.quiet);
        } else {
            wrapped(c, how_to(c.state.form.kind), c.theme.quiet);
        }
    }
    tilt_controls(c, region);
    overlay_buttons(c);
    const auto clear = [&](const char* label, std::vector<FormGuide> shape,
                           std::vector<FormGuide> strokes) {
        if (button(c, label, {.icon = icons::kClose, .width = -1}))
            c.emit(DoEdits{edits_of_form(region, shape, strokes), label});
    };
    if (!form.shape.empty()) clear("Remove shape", {}, form.strokes);
    if (!form.strokes.empty()) clear("Remove strokes", form.shape, {});
    section_gap(c);
}

}  // namespace weft::ui

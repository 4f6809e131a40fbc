// The inspector's section for the texture's colour and its way over the old surface.
#include <utility>
#include <vector>

#include "app/project/edit.h"
#include "ui/base/icons.h"
#include "ui/light/sections.h"
#include "ui/parameters/parameters.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

void change(Ctx& c, const Region& before, const Region& after, const char* label) {
    std::vector<Edit> edits = region_edits(before, after);
    if (!edits.empty()) c.emit(DoEdits{std::move(edits), label});
}

void grade_buttons(Ctx& c, const Region& region) {
    const float half = (ImGui::GetContentRegionAvail().x - c.theme.gap) / 2;
    const bool matched = region.grade.match == 1 && !region.light.cast;
    if (button(c, "Match plate",
               {.enabled = !matched,
                .tip = "Exposure as the plate's, and colour as its light's",
                .width = half})) {
        Region after = region;
        after.grade.match = 1;
        after.light.cast.reset();
        change(c, region, after, "Match plate");
    }
    ImGui::SameLine(0, c.theme.gap);
    GradeParams usual;
    usual.extra = region.grade.extra;
    LayerParams over;
    over.extra = region.layer.extra;
    if (button(c, "Reset##grade",
               {.enabled = region.grade != usual || region.layer != over,
                .tip = "Every control of this section as for a new region",
                .width = half})) {
        Region after = region;
        after.grade = usual;
        after.layer = over;
        change(c, region, after, "Reset grade");
    }
}

}  // namespace

void grade_section(Ctx& c, const Region& region) {
    if (!section(c, "Grade")) return;
    const PanelName panel(c, "Grade");
    grade_buttons(c, region);
    for (const char* key :
         {"grade.match", "grade.exposure", "grade.temperature", "grade.saturation", "grade.hue_deg",
          "grade.contrast", "grade.gamma", "grade.multiply", "grade.offset", "layer.opacity"})
        region_parameter(c, region, key);
    region_parameter(c, region, "layer.blend", "Blend mode");
    section_gap(c);
}

}  // namespace weft::ui

// The inspector of the Seams & Light workspace.
#include <algorithm>
#include <cmath>

#include "ui/base/icons.h"
#include "ui/light/light.h"
#include "ui/light/sections.h"
#include "ui/parameters/parameters.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {

namespace {

// The light's colour: as the plate shows it, or an amount of it.
void light_tint(Ctx& c, const Region& region) {
    const auto set = [&](ParameterValue value) {
        c.edit(SetRegionParameter{{region.id, {}}, "light.cast", std::move(value)});
    };
    bool automatic = !region.light.cast;
    if (checkbox(c, "Automatic light tint", automatic,
                 "The texture takes the light's colour as far as the plate gives evidence of it"))
        set(automatic ? ParameterValue{} : ParameterValue{1.0});
    if (region.light.cast) region_parameter(c, region, "light.cast", "Light tint");
}

}  // namespace

void light_inspector(Ctx& c) {
    const Region* region = c.view.selected_region();
    if (!region) return no_region(c);
    const Theme& t = c.theme;
    // The settings of the tool in hand come first.
    const bool keeping = c.state.tool == Tool::kKeep;
    if (keeping) keep_section(c, *region);
    if (section(c, "Light")) {
        const PanelName panel(c, "Light");
        region_parameter(c, *region, "light.source", "Light");
        if (region->light.source == LightSource::kImage)
            region_parameter(c, *region, "light.image", "Picture");
        if (region->light.source == LightSource::kPainted) lamps_controls(c, *region);
        if (region->light.source != LightSource::kNone) {
            keyed_parameter(c, *region, "light.strength", "light.strength_keys");
            region_parameter(c, *region, "light.detail");
            region_parameter(c, *region, "light.keep_detail");
            light_tint(c, *region);
            region_parameter(c, *region, "light.highlights", "Keep highlights");
            if (region->light.highlights > 0) region_parameter(c, *region, "light.roughness");
            region_parameter(c, *region, "light.form", "Light mode");
        }
        const auto unsure = c.view.preview.lights.find(region->id);
        if (unsure != c.view.preview.lights.end()) wrapped(c, unsure->second, t.warn);
        const auto show = [&](const char* command, const char* name, const char* tip) {
            const Command* over = c.commands.find(command);
            bool on = over->checked(c);
            if (checkbox(c, name, on, tip)) over->run(c);
        };
        show("view.light", "Show shading", "The plate's estimated shading on the surface");
        show("view.light_confidence", "Show light confidence",
             "Where light and paint of the old surface were told apart, and where they were not");
        section_gap(c);
    }
    if (section(c, "Seams")) {
        const PanelName panel(c, "Seams");
        const bool grown = region->texture.plane.empty() && !shows_sample(region->texture.mode);
        if (!grown) {
            wrapped(c, "This texture is not synthesized, so it has no seams.", t.quiet);
        } else {
            region_parameter(c, *region, "synthesis.seam", "Cut");
            region_parameter(c, *region, "synthesis.overlap_px");
            region_parameter(c, *region, "synthesis.feather_px");
            region_parameter(c, *region, "synthesis.refine");
            region_parameter(c, *region, "synthesis.rotations", "Allow rotation");
            region_parameter(c, *region, "synthesis.mirror", "Allow mirroring");
            region_parameter(c, *region, "synthesis.align", "Align rows");
            region_parameter(c, *region, "synthesis.seam_cost", "Seam cost");
            region_parameter(c, *region, "texture.also", "More samples");
            project_parameter(c, "settings.seed", "Seed");
            const Command* over = c.commands.find("view.seams");
            bool on = over->checked(c);
            if (checkbox(c, "Show seams", on,
                         "Seams between patches, by how much the patches differ"))
                over->run(c);
        }
        section_gap(c);
    }
    if (!keeping) keep_section(c, *region);
    grade_section(c, *region);
    time_section(c, *region);
    if (section(c, "Camera", false)) {
        const PanelName panel(c, "Camera");
        region_parameter(c, *region, "finish.grain", "Grain");
        region_parameter(c, *region, "finish.focus", "Focus");
        const bool own = region->finish.shutter_deg.has_value();
        quiet(c, "Motion blur is visible at final quality");
        if (own) region_parameter(c, *region, "finish.shutter_deg", "Shutter");
        if (button(c, own ? "Match plate shutter" : "Set shutter…",
                   {.icon = icons::kCamera,
                    .tip = "Shutter angle: blurs moving texture along its motion; 180° "
                           "is half a frame",
                    .width = -1}))
            c.edit(SetRegionParameter{{region->id, {}},
                                      "finish.shutter_deg",
                                      own ? ParameterValue{} : ParameterValue{180.0}});
        region_parameter(c, *region, "lines.extract", "Keep ink lines");
        section_gap(c);
    }
}

}  // namespace weft::ui

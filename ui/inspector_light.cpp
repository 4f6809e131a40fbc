// The inspector of the Seams & Light workspace.
#include <algorithm>
#include <cmath>

#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace weft::ui {

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
            keyed_parameter(c, *region, "light.strength", "light.strength_keys");
            region_parameter(c, *region, "light.form", "Blend mode");
            region_parameter(c, *region, "light.cast", "Light tint");
            region_parameter(c, *region, "light.highlights", "Keep highlights");
        }
        const Command* over = c.commands.find("view.light");
        bool on = over->checked(c);
        if (checkbox(c, "Show shading", on, "The plate's estimated shading on the surface"))
            over->run(c);
        section_gap(c);
    }
    if (section(c, "Seams")) {
        const PanelName panel(c, "Seams");
        const bool grown = region->texture.plane.empty();
        if (!grown) {
            wrapped(c, "This texture is tiled, so it has no seams.", t.quiet);
        } else {
            region_parameter(c, *region, "synthesis.seam", "Cut");
            region_parameter(c, *region, "synthesis.overlap_px");
            region_parameter(c, *region, "synthesis.feather_px");
            region_parameter(c, *region, "synthesis.refine");
            region_parameter(c, *region, "synthesis.rotations", "Allow rotation");
            region_parameter(c, *region, "synthesis.mirror", "Allow mirroring");
            region_parameter(c, *region, "synthesis.align", "Align rows");
            region_parameter(c, *region, "synthesis.seam_cost", "Seam cost");
            region_parameter(c, *region, "texture.also", "Additional samples");
            project_parameter(c, "settings.seed", "Seed");
            const Command* over = c.commands.find("view.seams");
            bool on = over->checked(c);
            if (checkbox(c, "Show seams", on,
                         "Seams between patches, by how much the patches differ"))
                over->run(c);
        }
        section_gap(c);
    }
    keep_section(c, *region);
    time_section(c, *region);
    if (section(c, "Camera", false)) {
        const PanelName panel(c, "Camera");
        quiet(c, "Visible at final quality");
        region_parameter(c, *region, "finish.grain", "Grain");
        region_parameter(c, *region, "finish.focus", "Focus");
        const bool own = region->finish.shutter_deg.has_value();
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
    if (section(c, "Preview")) {
        const PanelName panel(c, "Preview");
        int quality = c.view.preview_quality == Quality::kDraft ? 0 : 1;
        if (segments(c, "Quality", {"Draft", "Final"}, quality))
            c.emit(SetPreviewQuality{quality == 0 ? Quality::kDraft : Quality::kFinal});
        if (c.view.preview.frame_seconds > 0)
            info_row(c, "Last frame", number_text(c.view.preview.frame_seconds, 2) + " s");
        section_gap(c);
    }
}

}  // namespace weft::ui

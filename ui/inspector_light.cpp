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
            region_parameter(c, *region, "light.form", "Put on as");
            region_parameter(c, *region, "light.cast", "Colour of light");
            region_parameter(c, *region, "light.highlights", "Gloss kept");
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
    keep_section(c, *region);
    time_section(c, *region);
    if (section(c, "Camera", false)) {
        const PanelName panel(c, "Camera");
        quiet(c, "Seen at final quality");
        region_parameter(c, *region, "finish.grain", "Grain");
        region_parameter(c, *region, "finish.focus", "Focus");
        const bool own = region->finish.shutter_deg.has_value();
        if (own) region_parameter(c, *region, "finish.shutter_deg", "Shutter");
        if (button(c, own ? "Shutter as the plate's" : "Set the shutter…",
                   {.icon = icons::kCamera,
                    .tip = "How long it is open: moving texture is blurred along its motion; 180° "
                           "is half a frame",
                    .width = -1}))
            c.edit(SetRegionParameter{{region->id, {}},
                                      "finish.shutter_deg",
                                      own ? ParameterValue{} : ParameterValue{180.0}});
        region_parameter(c, *region, "lines.extract", "Keep ink lines on top");
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

}  // namespace weft::ui

// The section for temporal parameters, which the inspectors of motion and light have.
#include "ui/parameters/parameters.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {

void time_section(Ctx& c, const Region& region) {
    if (!section(c, "Temporal mode")) return;
    const PanelName panel(c, "Time");
    region_parameter(c, region, "temporal.mode", "Mode");
    if (region.temporal.mode == TemporalMode::kPaper) {
        region_parameter(c, region, "temporal.blend");
        region_parameter(c, region, "temporal.weight");
    }
    section_gap(c);
}

}  // namespace weft::ui

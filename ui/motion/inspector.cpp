// Motion workspace: the source of the surface's motion.
#include <algorithm>
#include <cmath>

#include "ui/base/icons.h"
#include "ui/mask/mask.h"
#include "ui/motion/motion.h"
#include "ui/parameters/parameters.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {

// An automatic reference frame stays: it holds the placement.
void add_reference_frame(Ctx& c) {
    const Region* region = c.view.selected_region();
    if (!region) return;
    std::vector<double> frames(region->reference_frames.begin(), region->reference_frames.end());
    const auto chosen = c.view.preview.references.find(region->id);
    if (frames.empty() && chosen != c.view.preview.references.end())
        frames.push_back(chosen->second);
    if (std::find(frames.begin(), frames.end(), c.view.frame) != frames.end()) return;
    frames.push_back(c.view.frame);
    c.edit(SetRegionParameter{{region->id, {}}, "reference_frames", frames});
}

namespace {

void motion_source_section(Ctx& c, const Region& region) {
    if (!section(c, "Motion")) return;
    const PanelName panel(c, "Motion");
    if (!region.motion.track.empty()) {
        info_row(c, "Follows", region.motion.track, "Planar track: the surface is treated as flat");
        if (button(c, "Estimate motion", {.icon = icons::kRefresh, .width = -1}))
            c.edit(SetRegionParameter{{region.id, {}}, "motion.track", std::string()});
    } else if (region.motion.files.empty()) {
        info_row(c, "From", "Estimated from the plate");
        region_parameter(c, region, "temporal.surface", "Surface");
        if (button(c, "Use planar track…",
                   {.icon = icons::kCrosshairs,
                    .tip = "Corner pins of Nuke, After Effects or Mocha: .nk, .txt, .json",
                    .width = -1})) {
            c.state.browser.purpose = BrowserState::Purpose::kTrack;
            c.state.browser.just_opened = true;
        }
        if (button(c, "Use motion files…",
                   {.icon = icons::kFolderImage,
                    .tip = "Motion vectors from a renderer: .flo or KITTI 16-bit PNG",
                    .width = -1})) {
            c.state.browser.purpose = BrowserState::Purpose::kMotion;
            c.state.browser.just_opened = true;
        }
    } else {
        info_row(c, "Files", region.motion.files);
        region_parameter(c, region, "motion.direction", "Direction");
        if (button(c, "Estimate motion", {.icon = icons::kRefresh, .width = -1}))
            c.edit(SetRegionParameter{{region.id, {}}, "motion.files", std::string()});
    }
    section_gap(c);
}

}  // namespace

void motion_inspector(Ctx& c) {
    const Region* region = c.view.selected_region();
    if (!region) return no_region(c);
    const Theme& t = c.theme;
    const SessionView& v = c.view;
    if (section(c, "Reference frames")) {
        const PanelName panel(c, "Reference frames");
        const auto chosen = v.preview.references.find(region->id);
        const bool implicit =
            region->reference_frames.empty() && chosen != v.preview.references.end();
        if (implicit) {
            if (button(c, ("Frame " + std::to_string(chosen->second) + " (automatic)").c_str(),
                       {.icon = icons::kReference,
                        .look = chosen->second == v.frame ? Look::kNormal : Look::kQuiet,
                        .tip = "The first frame that shows the surface well; the placement is "
                               "made on it. It stays when you add another one"}))
                c.emit(GoToFrame{chosen->second});
        } else if (region->reference_frames.empty()) {
            wrapped(c, "Automatic: the first frame that shows the surface well.", t.quiet);
        }
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
                region->reference_frames.end() ||
            (implicit && chosen->second == v.frame);
        if (button(c, "Add this frame",
                   {.icon = icons::kPlus,
                    .enabled = !here,
                    .tip = "The surface is followed from here in both directions; between two "
                           "reference frames the tracks dissolve",
                    .width = -1})) {
            add_reference_frame(c);
        }
        section_gap(c);
    }
    hints_section(c, false);
    corrections_section(c, *region);
    motion_source_section(c, *region);
    motion_zones_section(c, *region);
    if (section(c, "Overlays")) {
        const PanelName panel(c, "Overlays");
        for (const char* id : {"view.grid", "view.stretch", "view.arrows", "view.trust"}) {
            const Command* command = c.commands.find(id);
            bool on = command->checked(c);
            if (checkbox(c, command->name.c_str(), on)) command->run(c);
        }
        section_gap(c);
    }
    time_section(c, *region);
}

}  // namespace weft::ui

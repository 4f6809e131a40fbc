// The part of the motion inspector for pins.
#include "ui/base/icons.h"
#include "ui/motion/motion.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {

void corrections_section(Ctx& c, const Region& region) {
    const Theme& t = c.theme;
    if (!section(c, "Corrections")) return;
    const PanelName panel(c, "Corrections");
    if (button(c, "Pin texture",
               {.icon = icons::kPin,
                .look = c.state.tool == Tool::kPin ? Look::kPrimary : Look::kNormal,
                .tip = "Click to hold a place, drag to move the texture back into place; "
                       "Ctrl removes a pin",
                .command = "tool.pin",
                .width = -1}))
        c.state.tool = Tool::kPin;
    if (region.corrections.empty())
        wrapped(c,
                "Where the texture slides, pin it on that frame; frames between two "
                "corrections are interpolated.",
                t.quiet);
    for (const auto& [frame, pins] : region.corrections) {
        ImGui::PushID(frame);
        const std::string label = "Frame " + std::to_string(frame) + ", " +
                                  std::to_string(pins.size()) +
                                  (pins.size() == 1 ? " pin" : " pins");
        if (button(c, label.c_str(),
                   {.icon = icons::kPin,
                    .look = frame == c.view.frame ? Look::kNormal : Look::kQuiet}))
            c.emit(GoToFrame{frame});
        ImGui::SameLine();
        if (icon_button(c, icons::kClose, ("Unpin " + std::to_string(frame)).c_str(), false,
                        nullptr, true, t.row))
            c.edit(SetCorrection{{region.id, {}}, frame, {}});
        ImGui::PopID();
    }
    section_gap(c);
}

}  // namespace weft::ui

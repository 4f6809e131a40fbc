// The part of the motion inspector for pins.
#include <algorithm>

#include "ui/base/icons.h"
#include "ui/mask/mask.h"
#include "ui/motion/motion.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {

void go_to_suggested(Ctx& c) {
    const std::vector<CorrectionHint>& all = c.view.to_correct;
    if (all.empty()) {
        if (c.notify) c.notify(NoticeKind::kInfo, no_hints_text(c.view));
        return;
    }
    const auto here = std::find_if(all.begin(), all.end(), [&](const CorrectionHint& hint) {
        return hint.frame == c.view.frame;
    });
    const bool goes_on = here != all.end() && here + 1 != all.end();
    c.emit(GoToFrame{goes_on ? (here + 1)->frame : all.front().frame});
}

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

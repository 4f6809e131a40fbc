#include "ui/base/ctx.h"

namespace weft {

void Ctx::mark_pointed(std::string_view name, ImVec2 min, ImVec2 max) {
    PointedSetting& pointed = state.pointed;
    if (view.now_s > pointed.until_s) {
        pointed = {};
        return;
    }
    if (name != pointed.name) return;
    if (!pointed.section.empty() && pointed.section != pointed.in_section) return;
    if (!pointed.found) {
        pointed.found = true;
        pointed.found_in = pointed.in_section_id;
        ImGui::SetScrollHereY(0.5f);
    }
    const float gap = theme.px(3);
    ImGui::GetWindowDrawList()->AddRect({min.x - gap, min.y - gap}, {max.x + gap, max.y + gap},
                                        theme.accent_hover, theme.radius, 0, theme.px(2));
}

// Out of line: every panel emits actions, and the variant's copies cost two seconds to compile.
void Ctx::emit(Action action) {
    actions.push_back(std::move(action));
}

void Ctx::emit_now(const std::vector<Action>& all) {
    if (act_now) return act_now(all);
    actions.insert(actions.end(), all.begin(), all.end());
}

void Ctx::edit(Edit what) {
    emit(DoEdit{std::move(what)});
}

void Ctx::drop_tried() {
    emit(TryEdits{});
}

void Ctx::note(std::string_view name, ImVec2 min, ImVec2 max, bool enabled) {
    if (!state.pointed.name.empty()) mark_pointed(name, min, max);
    if (!items) return;
    items->push_back({(panel.empty() ? "" : panel + "/") + std::string(name), min, max, enabled});
}

void Ctx::note(std::string_view name, bool enabled) {
    note(name, ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), enabled);
}

}  // namespace weft

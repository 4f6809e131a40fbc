#include "ui/base/ctx.h"

namespace weft {

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
    if (!items) return;
    items->push_back({(panel.empty() ? "" : panel + "/") + std::string(name), min, max, enabled});
}

void Ctx::note(std::string_view name, bool enabled) {
    note(name, ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), enabled);
}

}  // namespace weft

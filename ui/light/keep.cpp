// Locking and regenerating patches of the synthesized texture: the tool on the
// canvas and its part of the inspector.
#include <algorithm>
#include <cmath>

#include "app/textures/patch_pick.h"
#include "ui/base/icons.h"
#include "ui/canvas/handles.h"
#include "ui/light/light.h"
#include "ui/light/sections.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

const Provenance* provenance(const Ctx& c) {
    const auto& over = c.view.overlay_picture;
    return over && over->provenance ? over->provenance.get() : nullptr;
}

void set_amendments(Ctx& c, const Region& region, std::vector<PlaneAmendment> amendments) {
    c.edit(SetAmendments{{region.id, {}}, std::move(amendments)});
}

void add_amendment(Ctx& c, const Region& region, PlaneAmendment one, Vec2 at) {
    std::vector<PlaneAmendment> all = *region.amendments;
    one.kind = c.state.keep_again ? PlaneAmendment::Kind::kAgain : PlaneAmendment::Kind::kKeep;
    if (c.state.keep_again) {
        // A second click on the same place tries another seed.
        if (const auto before = amendment_at(all, *provenance(c), at);
            before && all[*before].kind == PlaneAmendment::Kind::kAgain) {
            ++all[*before].seed;
            return set_amendments(c, region, std::move(all));
        }
        one.seed = static_cast<std::uint32_t>(all.size());
    }
    all.push_back(std::move(one));
    set_amendments(c, region, std::move(all));
}

void click(Ctx& c, const Region& region, Vec2 at) {
    const Provenance& from = *provenance(c);
    const ImGuiIO& io = ImGui::GetIO();
    if (subtracts()) {
        std::vector<PlaneAmendment> left = *region.amendments;
        if (const auto index = amendment_at(left, from, at)) {
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(*index));
            set_amendments(c, region, std::move(left));
        }
        return;
    }
    const bool seam = c.state.keep_seams != io.KeyShift;
    if (auto one = seam ? seam_at(from, at) : patch_at(from, at))
        add_amendment(c, region, std::move(*one), at);
}

std::int64_t texels_of(const PlaneAmendment& amendment) {
    std::int64_t sum = 0;
    for (const TexelRun& run : amendment.runs)
        sum += run.count;
    return sum;
}

}  // namespace

void keep_tool(Ctx& c, const ViewMap& map, bool hovered, bool active) {
    const Region* region = c.view.selected_region();
    if (!region) return;
    // The tool needs its overlay.
    if (c.view.overlay != Overlay::kSourceMap) {
        c.emit(ShowOverlay{Overlay::kSourceMap});
        c.state.keep_overlay = true;
    }
    if (hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    UiState& s = c.state;
    const Vec2 at = map.to_plate(ImGui::GetIO().MousePos);
    if (active && ImGui::IsMouseClicked(0)) s.rectangle_from = at;
    if (!s.rectangle_from) return;
    const Vec2 from = *s.rectangle_from;
    const float moved = std::hypot(at.x - from.x, at.y - from.y) * map.zoom;
    const bool rectangle = moved > c.theme.px(5);
    if (rectangle) {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const ImVec2 a = map.to_screen(from), b = map.to_screen(at);
        const ImVec2 low(std::min(a.x, b.x), std::min(a.y, b.y));
        const ImVec2 high(std::max(a.x, b.x), std::max(a.y, b.y));
        list.AddRect(low, high, IM_COL32(0, 0, 0, 180), 0, 0, c.theme.px(3));
        list.AddRect(low, high, c.theme.accent_hover, 0, 0, c.theme.px(1.5f));
    }
    if (ImGui::IsMouseDown(0)) return;
    s.rectangle_from.reset();
    const Provenance* asked = provenance(c);
    if (!asked || !asked->plane) return;
    if (!rectangle) return click(c, *region, at);
    if (auto one = places_in(*asked, from, at))
        add_amendment(c, *region, std::move(*one), (from + at) * 0.5f);
}

void keep_section(Ctx& c, const Region& region) {
    if (!section(c, "Lock and regenerate patches")) return;
    const PanelName panel(c, "Keep");
    const Theme& t = c.theme;
    if (!region.texture.plane.empty() || shows_sample(region.texture.mode) ||
        region.temporal.mode != TemporalMode::kLocked) {
        wrapped(c, "Only a synthesized texture that is locked to the surface has patches to lock.",
                t.quiet);
        return section_gap(c);
    }
    int what = c.state.keep_again ? 1 : 0;
    if (segments(c, "What", {"Lock", "Regenerate"}, what)) c.state.keep_again = what == 1;
    int which = c.state.keep_seams ? 1 : 0;
    if (segments(c, "Which", {"Patch", "Seam"}, which)) c.state.keep_seams = which == 1;
    const bool on = c.state.tool == Tool::kKeep;
    if (button(c, "Select on the picture",
               {.icon = icons::kLock,
                .look = on ? Look::kPrimary : Look::kNormal,
                .tip = "Click a patch or a seam, or drag a rectangle; Ctrl deselects. "
                       "Locked patches stay whatever else you change",
                .command = "tool.keep",
                .width = -1}))
        c.state.tool = Tool::kKeep;
    if (on && !provenance(c)) quiet(c, "Finding patches…");
    if (region.amendments->empty())
        wrapped(c,
                "Lock a patch that is right before you change seams, overlap or seed, or "
                "regenerate one that is not.",
                t.quiet);
    for (std::size_t k = 0; k < region.amendments->size(); ++k) {
        const PlaneAmendment& one = (*region.amendments)[k];
        const bool again = one.kind == PlaneAmendment::Kind::kAgain;
        ImGui::PushID(static_cast<int>(k));
        const std::string number = std::to_string(k + 1);
        const std::string label = (again ? "Regenerated, " : "Locked, ") +
                                  std::to_string(texels_of(one)) + " texels##amendment" + number;
        const float width = ImGui::GetContentRegionAvail().x - t.px(26) - t.gap;
        if (button(c, label.c_str(),
                   {.icon = again ? icons::kRefresh : icons::kLock,
                    .look = Look::kQuiet,
                    .tip = again ? "Regenerate with another seed" : "These texels stay as they are",
                    .width = width}) &&
            again) {
            std::vector<PlaneAmendment> all = *region.amendments;
            ++all[k].seed;
            set_amendments(c, region, std::move(all));
        }
        c.note("Amendment " + number);
        ImGui::SameLine();
        if (icon_button(c, icons::kClose, ("Release " + number).c_str(), false, nullptr, true,
                        t.row)) {
            std::vector<PlaneAmendment> left = *region.amendments;
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
            set_amendments(c, region, std::move(left));
        }
        ImGui::PopID();
    }
    section_gap(c);
}

}  // namespace weft::ui

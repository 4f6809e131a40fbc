// The inspector of the Mask workspace, its second half: what stands in front of the surface, and
// how what is painted goes to the other frames.
#include <algorithm>
#include <cmath>

#include "app/mattes/matte_layer.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace weft::ui {
namespace {

std::string name_of_layer(const MatteSource& holdout, int layer) {
    const std::string title = "Layer " + std::to_string(layer);
    if (holdout.empty()) return title + ", not painted yet";
    if (!holdout.select.crypto.empty()) return title + ": " + holdout.select.crypto;
    if (!holdout.files.empty()) {
        const std::size_t slash = holdout.files.find_last_of('/');
        return title + ": " + holdout.files.substr(slash == std::string::npos ? 0 : slash + 1);
    }
    const std::size_t keys = holdout.keyframes.size();
    return title + ": painted on " + std::to_string(keys) + (keys == 1 ? " frame" : " frames");
}

void layer_row(Ctx& c, const Region& region, int layer) {
    const Theme& t = c.theme;
    const MatteSource& holdout = layer_source(region, layer);
    const bool chosen = c.view.matte_layer == layer;
    ImGui::PushID(layer);
    const float width = ImGui::GetContentRegionAvail().x - t.px(26) - t.gap;
    const std::string label = fitted(name_of_layer(holdout, layer), width - t.px(36)) +
                              "##holdout" + std::to_string(layer);
    if (button(c, label.c_str(),
               {.icon = icons::kBrush,
                .look = chosen ? Look::kPrimary : Look::kNormal,
                .tip = holdout.files.empty() ? "Brush, shapes and keyframes edit this layer"
                                             : "Select it to paint over its files",
                .width = width}))
        c.emit(SelectMatteLayer{chosen ? 0 : layer});
    c.note("Layer " + std::to_string(layer));
    ImGui::SameLine();
    if (icon_button(c, icons::kClose, ("Remove layer " + std::to_string(layer)).c_str(), false,
                    nullptr, true, t.row)) {
        std::vector<MatteSource> left = *region.holdouts;
        if (layer <= static_cast<int>(left.size())) {
            left.erase(left.begin() + layer - 1);
            c.edit(SetHoldouts{{region.id, {}}, left});
        }
        c.emit(SelectMatteLayer{0});
    }
    ImGui::PopID();
}

// Another region's matte serves as well.
void other_regions(Ctx& c, const Region& region) {
    for (const Leaf<Region>& other : c.view.project.regions) {
        if (other->id == region.id || other->matte->empty()) continue;
        const auto& list = *region.holdouts;
        const bool has = std::any_of(list.begin(), list.end(),
                                     [&](const MatteSource& m) { return m == *other->matte; });
        if (!has && button(c, ("Cut out " + other->name).c_str(),
                           {.icon = icons::kMinus,
                            .tip = "Cuts that region's matte out of this one",
                            .width = -1})) {
            std::vector<MatteSource> more = list;
            more.push_back(*other->matte);
            c.edit(SetHoldouts{{region.id, {}}, more});
        }
    }
}

void carry_progress(Ctx& c) {
    const SessionView& v = c.view;
    const float part = v.preview.total > 0 ? static_cast<float>(v.preview.done) /
                                                 static_cast<float>(v.preview.total)
                                           : 0;
    progress_bar(c, part,
                 "Propagating the matte, " + std::to_string(v.preview.done) + " of " +
                     std::to_string(v.preview.total));
    if (button(c, "Pause", {.icon = icons::kPause, .width = -1})) c.emit(PauseAnalysis{true});
}

// Which way, and how far.
void carry_controls(Ctx& c, const Region& region, const MatteSource& source) {
    const Theme& t = c.theme;
    const SessionView& v = c.view;
    const auto change = [&](auto&& set) {
        MatteSource changed = source;
        set(changed);
        c.edit(set_layer(region, v.matte_layer, changed));
    };
    int way = source.carry == PropagationDirection::kBackward  ? 0
              : source.carry == PropagationDirection::kForward ? 2
                                                               : 1;
    if (segments(c, "Direction", {"Backwards", "Both", "Forwards"}, way)) {
        constexpr PropagationDirection kWays[] = {PropagationDirection::kBackward,
                                                  PropagationDirection::kBoth,
                                                  PropagationDirection::kForward};
        change([&](MatteSource& m) { m.carry = kWays[way]; });
    }
    const auto end = [](const std::optional<int>& frame, const char* otherwise) {
        return frame ? std::to_string(*frame) : std::string(otherwise);
    };
    info_row(c, "Frames",
             source.carry_from || source.carry_to
                 ? end(source.carry_from, "the first") + " to " + end(source.carry_to, "the last")
                 : "the whole shot",
             "Other frames have no matte unless one is painted");
    const bool marked = v.mark_in || v.mark_out;
    const float half = std::floor((ImGui::GetContentRegionAvail().x - t.gap) * 0.5f);
    if (button(
            c, "Marked range",
            {.enabled = marked && (source.carry_from != v.mark_in || source.carry_to != v.mark_out),
             .tip = "Propagates it between the in and out points only",
             .width = half}))
        change([&](MatteSource& m) {
            m.carry_from = v.mark_in;
            m.carry_to = v.mark_out;
        });
    ImGui::SameLine();
    if (button(c, "Whole shot",
               {.enabled = source.carry_from || source.carry_to,
                .tip = "Propagates it to all frames",
                .width = half}))
        change([](MatteSource& m) {
            m.carry_from.reset();
            m.carry_to.reset();
        });
}

}  // namespace

void holdouts_section(Ctx& c, const Region& region) {
    if (!section(c, "Holdouts", !region.holdouts->empty() || c.view.matte_layer > 0)) return;
    const PanelName panel(c, "Holdouts");
    const int count = static_cast<int>(region.holdouts->size());
    if (count == 0 && c.view.matte_layer == 0)
        wrapped(c,
                "Holdouts are cut out of the matte; the surface reappears behind them with the "
                "same texture.",
                c.theme.quiet);
    for (int layer = 1; layer <= std::max(count, c.view.matte_layer); ++layer)
        layer_row(c, region, layer);
    if (c.view.matte_layer > 0) {
        if (button(c, "Back to the matte",
                   {.icon = icons::kArrowLeft,
                    .look = Look::kQuiet,
                    .tip = "Brush, shapes and keyframes edit the region's own matte",
                    .width = -1}))
            c.emit(SelectMatteLayer{0});
    } else if (button(c, "Paint a holdout",
                      {.icon = icons::kBrush,
                       .enabled = c.view.plate.state == PlateView::State::kOpen,
                       .tip = "Adds a layer: paint over what hides the surface. It is propagated "
                              "like a matte",
                       .width = -1})) {
        c.emit(SelectMatteLayer{count + 1});
        if (c.state.tool == Tool::kPan) c.state.tool = Tool::kBrush;
    }
    other_regions(c, region);
    if (button(c, "Add matte files…##holdout", {.icon = icons::kFolderImage, .width = -1})) {
        c.state.browser.purpose = BrowserState::Purpose::kHoldout;
        c.state.browser.just_opened = true;
    }
    section_gap(c);
}

void propagation_section(Ctx& c, const Region& region) {
    if (!section(c, "Other frames")) return;
    const PanelName panel(c, "Propagation");
    const SessionView& v = c.view;
    const MatteSource source = v.painted_source();
    if (source.keyframes.empty()) {
        wrapped(c,
                source.files.empty()
                    ? "Painted mattes are propagated to the other frames automatically."
                    : "The files provide a matte for every frame.",
                c.theme.quiet);
        return section_gap(c);
    }
    carry_controls(c, region, source);
    if (v.preview.analysing) {
        carry_progress(c);
    } else if (v.analysis_paused) {
        if (button(c, "Continue", {.icon = icons::kPlay, .look = Look::kPrimary, .width = -1}))
            c.emit(PauseAnalysis{false});
    } else if (v.unready.contains(region.id)) {
        wrapped(c, "Choose a texture to propagate the matte through the shot.", c.theme.quiet);
    } else {
        wrapped(c,
                "Propagated through the shot. The strip below the ruler is light where confidence "
                "unsure.",
                c.theme.quiet);
    }
    section_gap(c);
}

}  // namespace weft::ui

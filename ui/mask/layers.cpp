// Mask workspace, second part: holdouts and propagation.
#include <algorithm>
#include <cmath>

#include "app/mattes/matte_layer.h"
#include "ui/base/icons.h"
#include "ui/mask/layer_rows.h"
#include "ui/mask/sections.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

// Offers other regions' mattes as holdouts.
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

// How far the matte has come, by frames of the shot.
void propagation_progress(Ctx& c) {
    const SessionView& v = c.view;
    const std::size_t reached = v.reached.size(), all = v.plate.frames.size();
    const bool over = reached == all;
    progress_bar(c, static_cast<float>(reached) / static_cast<float>(std::max<std::size_t>(1, all)),
                 over ? "Propagated through the shot"
                      : std::string(v.analysis_paused ? "Paused" : "Propagating") + ": " +
                            std::to_string(reached) + " of " + std::to_string(all) + " frames");
    c.note(over ? "Propagated" : "Reached " + std::to_string(reached));
    if (v.analysis_paused) {
        if (button(c, "Continue",
                   {.icon = icons::kPlay, .look = Look::kPrimary, .enabled = !over, .width = -1}))
            c.emit(PauseAnalysis{false});
    } else if (button(c, "Pause", {.icon = icons::kPause, .enabled = !over, .width = -1})) {
        c.emit(PauseAnalysis{true});
    }
    // The strip comes with the confidence, a moment after the last matte.
    const bool confident = std::any_of(v.marks.begin(), v.marks.end(),
                                       [](const FrameMarks& m) { return m.confidence >= 0; });
    std::string text;
    if (!over)
        text = "Frames still to come show what they showed before the last change.";
    else if (confident)
        text = "The strip below the ruler is pale where the confidence is low.";
    wrapped_in(c, text, c.theme.quiet, 2);
    if (!text.empty()) c.note("About: " + text);
}

// Direction and range of propagation.
void propagation_controls(Ctx& c, const Region& region, const MatteSource& source) {
    const Theme& t = c.theme;
    const SessionView& v = c.view;
    const auto change = [&](auto&& set) {
        MatteSource changed = source;
        set(changed);
        c.edit(set_layer(region, v.matte_layer, changed));
    };
    int way = source.propagate_direction == PropagationDirection::kBackward  ? 0
              : source.propagate_direction == PropagationDirection::kForward ? 2
                                                                             : 1;
    if (segments(c, "Direction", {"Backwards", "Both", "Forwards"}, way)) {
        constexpr PropagationDirection kWays[] = {PropagationDirection::kBackward,
                                                  PropagationDirection::kBoth,
                                                  PropagationDirection::kForward};
        change([&](MatteSource& m) { m.propagate_direction = kWays[way]; });
    }
    const auto end = [](const std::optional<int>& frame, const char* otherwise) {
        return frame ? std::to_string(*frame) : std::string(otherwise);
    };
    info_row(c, "Frames",
             source.propagate_from || source.propagate_to
                 ? end(source.propagate_from, "the first") + " to " +
                       end(source.propagate_to, "the last")
                 : "the whole shot",
             "Other frames have no matte unless one is painted");
    const bool marked = v.mark_in || v.mark_out;
    const float half = std::floor((ImGui::GetContentRegionAvail().x - t.gap) * 0.5f);
    if (button(c, "Marked range",
               {.enabled = marked && (source.propagate_from != v.mark_in ||
                                      source.propagate_to != v.mark_out),
                .tip = "Propagates it between the in and out points only",
                .width = half}))
        change([&](MatteSource& m) {
            m.propagate_from = v.mark_in;
            m.propagate_to = v.mark_out;
        });
    ImGui::SameLine();
    if (button(c, "Whole shot",
               {.enabled = source.propagate_from || source.propagate_to,
                .tip = "Propagates it to all frames",
                .width = half}))
        change([](MatteSource& m) {
            m.propagate_from.reset();
            m.propagate_to.reset();
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
    if (c.view.matte_layer > 0)
        back_to_matte(c);
    else
        begin_layer(c, "Paint a holdout",
                    "Adds a layer: paint over what hides the surface. It is propagated like a "
                    "matte",
                    {last_layer(region)});
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
                !source.shape.empty() ? "The shape is drawn on every frame."
                : source.files.empty()
                    ? "Painted mattes are propagated to the other frames automatically."
                    : "The files provide a matte for every frame.",
                c.theme.quiet);
        return section_gap(c);
    }
    propagation_controls(c, region, source);
    if (region.enabled)
        propagation_progress(c);
    else
        wrapped(c, "Propagated once the region is shown.", c.theme.quiet);
    section_gap(c);
}

}  // namespace weft::ui

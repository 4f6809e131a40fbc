// Mask workspace, second part: holdouts and propagation.
#include <algorithm>
#include <cmath>

#include "app/mattes/matte_layer.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace weft::ui {
namespace {

// "Layer 2" of the holdouts, "Zone 1".
std::string title_of_layer(int layer) {
    return is_zone_layer(layer) ? "Zone " + std::to_string(zone_of_layer(layer) + 1)
                                : "Layer " + std::to_string(layer);
}

std::string name_of_layer(const MatteSource& holdout, int layer) {
    const std::string title = title_of_layer(layer);
    if (holdout.empty()) return title + ", not painted yet";
    if (!holdout.select.crypto.empty()) return title + ": " + holdout.select.crypto;
    if (!holdout.shape.empty()) return title + ": roto shape";
    if (!holdout.files.empty()) {
        const std::size_t slash = holdout.files.find_last_of('/');
        return title + ": " + holdout.files.substr(slash == std::string::npos ? 0 : slash + 1);
    }
    const std::size_t keys = holdout.keyframes.size();
    return title + ": painted on " + std::to_string(keys) + (keys == 1 ? " frame" : " frames");
}

void remove_layer(Ctx& c, const Region& region, int layer) {
    const RegionRef ref{region.id, {}};
    if (is_zone_layer(layer)) {
        std::vector<Zone> left = *region.zones;
        const int zone = zone_of_layer(layer);
        if (zone >= static_cast<int>(left.size())) return;
        left.erase(left.begin() + zone);
        return c.edit(SetZones{ref, left});
    }
    std::vector<MatteSource> left = *region.holdouts;
    if (layer > static_cast<int>(left.size())) return;
    left.erase(left.begin() + layer - 1);
    c.edit(SetHoldouts{ref, left});
}

void layer_row(Ctx& c, const Region& region, int layer) {
    const Theme& t = c.theme;
    const MatteSource& painted = layer_source(region, layer);
    const std::string title = title_of_layer(layer);
    const bool chosen = c.view.matte_layer == layer;
    ImGui::PushID(layer);
    const float width = ImGui::GetContentRegionAvail().x - t.px(26) - t.gap;
    const std::string label =
        fitted(name_of_layer(painted, layer), width - t.px(36)) + "##" + title;
    if (button(c, label.c_str(),
               {.icon = icons::kBrush,
                .look = chosen ? Look::kPrimary : Look::kNormal,
                .tip = painted.files.empty() ? "Brush, shapes and keyframes edit this layer"
                                             : "Select it to paint over its files",
                .width = width}))
        c.emit(SelectMatteLayer{chosen ? 0 : layer});
    c.note(title);
    ImGui::SameLine();
    const std::string remove =
        is_zone_layer(layer) ? "Remove z" + title.substr(1) : "Remove l" + title.substr(1);
    if (icon_button(c, icons::kClose, remove.c_str(), false, nullptr, true, t.row)) {
        remove_layer(c, region, layer);
        c.emit(SelectMatteLayer{0});
    }
    ImGui::PopID();
}

void back_to_matte(Ctx& c) {
    if (button(c, "Back to the matte",
               {.icon = icons::kArrowLeft,
                .look = Look::kQuiet,
                .tip = "Brush, shapes and keyframes edit the region's own matte",
                .width = -1}))
        c.emit(SelectMatteLayer{0});
}

// Button that adds a holdout or zone.
void begin_layer(Ctx& c, const char* label, const char* tip, SelectMatteLayer begin) {
    if (!button(c, label,
                {.icon = icons::kBrush,
                 .enabled = c.view.plate.state == PlateView::State::kOpen,
                 .tip = tip,
                 .width = -1}))
        return;
    c.emit(begin);
    if (c.state.tool == Tool::kPan) c.state.tool = Tool::kBrush;
}

void begin_zones(Ctx& c, int layer) {
    begin_layer(c, "Paint: this is light",
                "Adds a zone: what the plate shows there falls on the new texture. It is "
                "propagated like a matte",
                {layer, ZoneKind::kDetail, 1});
    begin_layer(c, "Paint: this is paint",
                "Adds a zone: what the plate shows there belongs to the old surface and goes. It "
                "is propagated like a matte",
                {layer, ZoneKind::kDetail, 0});
    begin_layer(c, "Paint a light zone",
                "Adds a zone in which the texture takes less or more of the light. It is "
                "propagated like a matte",
                {layer, ZoneKind::kLight, 0});
}

void zone_value(Ctx& c, const Region& region, std::size_t zone) {
    const Zone& now = (*region.zones)[zone];
    const bool detail = now.kind == ZoneKind::kDetail;
    if (!now.value_keys.empty()) return info_row(c, detail ? "Light detail" : "Light", "Animated");
    double value = now.value;
    SliderSpec spec;
    spec.label = detail ? "Light detail" : "Light";
    spec.tip = detail ? "What counts as light inside the zone: 0 it is paint, 1 it is light, all "
                        "that the plate shows"
                      : "How much of the light the texture takes inside the zone: 0 none, 1 as "
                        "elsewhere, 2 twice the contrast";
    spec.max = detail ? 1 : 2;
    spec.standard = 0;
    const Change change = slider(c, spec, value);
    if (change == Change::kNone) return;
    std::vector<Zone> zones = *region.zones;
    zones[zone].value = value;
    const SetZones set{{region.id, {}}, zones};
    if (change == Change::kDone)
        c.emit(DoEdit{set});
    else
        c.emit(TryEdit{set});
}

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

void propagation_progress(Ctx& c) {
    const SessionView& v = c.view;
    const float part = v.preview.total > 0 ? static_cast<float>(v.preview.done) /
                                                 static_cast<float>(v.preview.total)
                                           : 0;
    progress_bar(c, part,
                 "Propagating the matte, " + std::to_string(v.preview.done) + " of " +
                     std::to_string(v.preview.total));
    if (button(c, "Pause", {.icon = icons::kPause, .width = -1})) c.emit(PauseAnalysis{true});
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

void zones_section(Ctx& c, const Region& region) {
    const int count = static_cast<int>(region.zones->size());
    const bool painting = is_zone_layer(c.view.matte_layer);
    if (!section(c, "Light zones", count > 0 || painting)) return;
    const PanelName panel(c, "Light zones");
    if (count == 0 && !painting)
        wrapped(c,
                "Inside a zone you say what is light: where a stain was taken for a shadow, or a "
                "shadow for paint.",
                c.theme.quiet);
    const int begun = painting ? zone_of_layer(c.view.matte_layer) + 1 : 0;
    for (int zone = 0; zone < std::max(count, begun); ++zone) {
        layer_row(c, region, zone_layer(zone));
        if (zone < count) {
            ImGui::PushID(zone);
            zone_value(c, region, static_cast<std::size_t>(zone));
            ImGui::PopID();
        }
    }
    if (painting)
        back_to_matte(c);
    else
        begin_zones(c, first_layer(region));
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
    if (v.preview.analysing) {
        propagation_progress(c);
    } else if (v.analysis_paused) {
        if (button(c, "Continue", {.icon = icons::kPlay, .look = Look::kPrimary, .width = -1}))
            c.emit(PauseAnalysis{false});
    } else if (v.unready.contains(region.id)) {
        wrapped(c, "Choose a texture to propagate the matte through the shot.", c.theme.quiet);
    } else {
        wrapped(c,
                "Propagated through the shot. The strip below the ruler is pale where the "
                "confidence is low.",
                c.theme.quiet);
    }
    section_gap(c);
}

}  // namespace weft::ui

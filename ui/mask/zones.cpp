// Zones of a region, in the workspaces of what they change: its light, or its motion.
#include <algorithm>
#include <array>

#include "app/mattes/matte_layer.h"
#include "ui/mask/layer_rows.h"
#include "ui/mask/mask.h"
#include "ui/mask/sections.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

struct ZoneWords {
    ZoneKind kind;
    const char *label, *tip;  ///< Of its value.
    double max, standard;
};

constexpr std::array<ZoneWords, 6> kZoneWords{
    {{ZoneKind::kLight, "Light",
      "How much of the light the texture takes inside the zone: 0 none, 1 as elsewhere, 2 twice "
      "the "
      "contrast",
      2, 0},
     {ZoneKind::kDetail, "Light detail",
      "What counts as light inside the zone: 0 it is paint, 1 it is light, all that the plate "
      "shows",
      1, 0},
     {ZoneKind::kIgnore, "Ignore picture",
      "How far the motion inside the zone comes from the surface around it: 0 as tracked, 1 "
      "altogether",
      1, 1},
     {ZoneKind::kStiffer, "Stiffer",
      "How far what is inside the zone moves as one flat, stiff piece: 0 as tracked, 1 altogether",
      1, 1},
     {ZoneKind::kCalmer, "Calmer",
      "How far the motion inside the zone is averaged over the frames around: 0 as tracked, 1 "
      "altogether",
      1, 1},
     {ZoneKind::kSurroundings, "Follow surroundings",
      "How far the zone moves with what the picture shows around it: 0 as tracked, 1 altogether", 1,
      1}}};

const ZoneWords& words_of(ZoneKind kind) {
    return *std::find_if(kZoneWords.begin(), kZoneWords.end(),
                         [&](const ZoneWords& words) { return words.kind == kind; });
}

void zone_value(Ctx& c, const Region& region, std::size_t zone) {
    const Zone& now = (*region.zones)[zone];
    const ZoneWords& words = words_of(now.kind);
    if (!now.value_keys.empty()) return info_row(c, words.label, "Animated");
    double value = now.value;
    SliderSpec spec;
    spec.label = words.label;
    spec.tip = words.tip;
    spec.max = words.max;
    spec.standard = words.standard;
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

void begin_light_zones(Ctx& c, int layer) {
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

void begin_motion_zones(Ctx& c, int layer) {
    begin_layer(c, "Paint: ignore the picture",
                "Adds a zone: what the plate shows there says nothing of the motion, a reflection "
                "or a passing shadow; the surface around it does",
                {layer, ZoneKind::kIgnore, 1});
    begin_layer(c, "Paint: stiffer",
                "Adds a zone that moves as one flat, stiff piece: straight lines stay straight",
                {layer, ZoneKind::kStiffer, 1});
    begin_layer(c, "Paint: calmer",
                "Adds a zone whose trembling is averaged away over the frames around",
                {layer, ZoneKind::kCalmer, 1});
    begin_layer(c, "Paint: follow the surroundings",
                "Adds a zone that moves with what the picture shows around it, as a poster does "
                "with its wall",
                {layer, ZoneKind::kSurroundings, 1});
}

// Those whose kind changes motion or light, and the one that is being begun.
void zone_rows(Ctx& c, const Region& region, bool of_motion) {
    const int count = static_cast<int>(region.zones->size());
    for (int zone = 0; zone < count; ++zone) {
        if (changes_motion((*region.zones)[static_cast<std::size_t>(zone)].kind) != of_motion)
            continue;
        layer_row(c, region, zone_layer(zone));
        ImGui::PushID(zone);
        zone_value(c, region, static_cast<std::size_t>(zone));
        ImGui::PopID();
    }
    const int layer = c.view.matte_layer;
    const bool begun = is_zone_layer(layer) && zone_of_layer(layer) >= count;
    if (begun && changes_motion(c.view.begun_zone.kind) == of_motion) layer_row(c, region, layer);
}

// Whether a zone of that sort is being painted.
bool paints(const Ctx& c, const Region& region, bool of_motion) {
    if (!is_zone_layer(c.view.matte_layer)) return false;
    const auto zone = static_cast<std::size_t>(zone_of_layer(c.view.matte_layer));
    const Zone& painted = zone < region.zones->size() ? (*region.zones)[zone] : c.view.begun_zone;
    return changes_motion(painted.kind) == of_motion;
}

bool has_zones(const Region& region, bool of_motion) {
    return std::any_of(region.zones->begin(), region.zones->end(),
                       [&](const Zone& zone) { return changes_motion(zone.kind) == of_motion; });
}

// The zones of one sort, and how to begin one.
void zones_section(Ctx& c, const Region& region, bool of_motion, const char* title,
                   const char* about) {
    const bool any = has_zones(region, of_motion), painting = paints(c, region, of_motion);
    if (!section(c, title, any || painting)) return;
    const PanelName panel(c, title);
    if (!any && !painting) wrapped(c, about, c.theme.quiet);
    zone_rows(c, region, of_motion);
    if (painting) {
        if (of_motion) brush_rows(c);  // in the Mask workspace they have a section of their own
        back_to_matte(c);
    } else if (of_motion) {
        begin_motion_zones(c, first_layer(region));
    } else {
        begin_light_zones(c, first_layer(region));
    }
    section_gap(c);
}

}  // namespace

void light_zones_section(Ctx& c, const Region& region) {
    zones_section(c, region, false, "Light zones",
                  "Inside a zone you say what is light: where a stain was taken for a shadow, or a "
                  "shadow for paint.");
}

void motion_zones_section(Ctx& c, const Region& region) {
    zones_section(
        c, region, true, "Motion zones",
        "Inside a zone you say how the surface moves, where the picture misleads. Nothing "
        "changes outside of it.");
}

}  // namespace weft::ui

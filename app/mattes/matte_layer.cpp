#include "app/mattes/matte_layer.h"

namespace weft {
namespace {

std::size_t zone_index(int layer) {
    return static_cast<std::size_t>(zone_of_layer(layer));
}
std::size_t holdout_index(int layer) {
    return static_cast<std::size_t>(layer) - 1;
}

}  // namespace

const MatteSource& layer_source(const Region& region, int layer) {
    static const MatteSource kNone;
    if (layer == 0) return *region.matte;
    if (is_zone_layer(layer)) {
        const std::size_t at = zone_index(layer);
        return at < region.zones->size() ? (*region.zones)[at].matte : kNone;
    }
    const std::size_t at = holdout_index(layer);
    return at < region.holdouts->size() ? (*region.holdouts)[at] : kNone;
}

int first_layer(const Region& region) {
    return zone_layer(static_cast<int>(region.zones->size()));
}

int last_layer(const Region& region) {
    return static_cast<int>(region.holdouts->size()) + 1;
}

Edit set_layer(const Region& region, int layer, MatteSource source, const Zone& begun) {
    const RegionRef ref{region.id, {}};
    if (layer == 0) return SetMatte{ref, std::move(source)};
    if (is_zone_layer(layer)) {
        std::vector<Zone> zones = *region.zones;
        const std::size_t at = zone_index(layer);
        Zone& zone = at < zones.size() ? zones[at] : zones.emplace_back(begun);
        zone.matte = std::move(source);
        return SetZones{ref, std::move(zones)};
    }
    std::vector<MatteSource> holdouts = *region.holdouts;
    const std::size_t at = holdout_index(layer);
    if (at < holdouts.size())
        holdouts[at] = std::move(source);
    else
        holdouts.push_back(std::move(source));
    return SetHoldouts{ref, std::move(holdouts)};
}

Edit without_layer_key(const Region& region, int layer, int frame) {
    const RegionRef ref{region.id, {}};
    if (layer == 0) return RemoveMatteKeyframe{ref, frame};
    if (is_zone_layer(layer)) {
        std::vector<Zone> zones = *region.zones;
        if (const std::size_t at = zone_index(layer); at < zones.size()) {
            zones[at].matte.keyframes.erase(frame);
            zones[at].matte.confirmed.erase(frame);
            if (zones[at].matte.empty()) zones.erase(zones.begin() + zone_of_layer(layer));
        }
        return SetZones{ref, std::move(zones)};
    }
    std::vector<MatteSource> holdouts = *region.holdouts;
    if (const std::size_t at = holdout_index(layer); at < holdouts.size()) {
        holdouts[at].keyframes.erase(frame);
        holdouts[at].confirmed.erase(frame);
        if (holdouts[at].empty()) holdouts.erase(holdouts.begin() + layer - 1);
    }
    return SetHoldouts{ref, std::move(holdouts)};
}

std::string layer_name(const Region& region, int layer) {
    if (layer == 0) return region.name;
    return (is_zone_layer(layer) ? "zone " + std::to_string(zone_of_layer(layer) + 1)
                                 : "holdout " + std::to_string(layer)) +
           " of " + region.name;
}

}  // namespace weft

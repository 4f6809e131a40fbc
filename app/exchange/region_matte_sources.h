#pragma once
// All of a region's mattes, wherever it keeps them.

#include <utility>
#include <vector>

#include "app/project/project.h"

namespace weft {

/// Calls `change` with the region's matte, its holdouts' and its zones', and keeps what it makes of
/// them.
template <class Change>
void change_matte_sources(Region& region, Change&& change) {
    MatteSource extent = *region.matte;
    change(extent);
    region.matte = std::move(extent);
    std::vector<MatteSource> holdouts = *region.holdouts;
    for (MatteSource& holdout : holdouts)
        change(holdout);
    if (!holdouts.empty()) region.holdouts = std::move(holdouts);
    std::vector<Zone> zones = *region.zones;
    for (Zone& zone : zones)
        change(zone.matte);
    if (!zones.empty()) region.zones = std::move(zones);
}

/// The same mattes, to look at.
[[nodiscard]] inline std::vector<const MatteSource*> matte_sources(const Region& region) {
    std::vector<const MatteSource*> all{&*region.matte};
    for (const MatteSource& holdout : *region.holdouts)
        all.push_back(&holdout);
    for (const Zone& zone : *region.zones)
        all.push_back(&zone.matte);
    return all;
}

}  // namespace weft

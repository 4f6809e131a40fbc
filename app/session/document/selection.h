#pragma once
// What of the document the artist works on.

#include <map>
#include <set>

#include "app/mattes/matte_layer.h"
#include "app/project/project.h"

namespace weft {

/// A value. The document that it is of is passed in.
struct Selection {
    RegionId region = 0;
    RegionId solo = 0;  ///< Only this region is shown in the preview; 0: all.
    int layer = 0;      ///< Of the selected region, as in SelectMatteLayer.
    Zone begun_zone;    ///< What a stroke beyond the last zone adds.
    std::set<RegionId> locked;

    /// Whether the selected region is locked.
    [[nodiscard]] bool is_locked() const { return locked.contains(region); }
    /// The selected region; null: there is none.
    [[nodiscard]] const Region* of(const Project& project) const {
        return region_by_id(project, region);
    }
    /// Selects the matte of the topmost region if the selected one is not there any more.
    void follow(const Project& project) {
        if (of(project)) return;
        region = project.regions.empty() ? 0 : project.regions.back()->id;
        layer = 0;
    }
    /// Selects the region's own matte if the layer was removed, by undo for instance.
    void keep_layer(const Project& project) {
        const Region* selected = of(project);
        if (!selected || layer < first_layer(*selected) || layer > last_layer(*selected)) layer = 0;
    }
    /// The same region after `renumbered`, new numbers by old ones.
    void renumber(const std::map<RegionId, RegionId>& renumbered) {
        if (const auto now = renumbered.find(region); now != renumbered.end()) region = now->second;
    }
};

}  // namespace weft

#include "app/exchange/merge_project.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "app/exchange/merge_settings.h"
#include "app/project/codec/project_json.h"
#include "app/project/validate.h"

namespace weft {
namespace {

using Json = nlohmann::json;

Expected<Json> json_of(const Project& project) {
    WEFT_TRY(text, project_to_json(project));
    return Json::parse(text);
}

RegionId id_of(const Json& region) {
    return region.at("id").get<RegionId>();
}

std::string name_of(const Json& region) {
    const std::string name = region.value("name", "");
    return name.empty() ? "region " + std::to_string(id_of(region)) : name;
}

/// A project in its parts.
struct Parts {
    explicit Parts(Json whole) : settings(std::move(whole)) {
        for (Json& region : settings["regions"]) {
            order.push_back(id_of(region));
            regions.emplace(id_of(region), std::move(region));
        }
        next_id = settings["next_region_id"].get<RegionId>();
        settings.erase("regions");
        settings.erase("next_region_id");
    }
    [[nodiscard]] const Json* find(RegionId id) const {
        const auto found = regions.find(id);
        return found == regions.end() ? nullptr : &found->second;
    }
    Json settings;  // without the regions
    std::map<RegionId, Json> regions;
    std::vector<RegionId> order;  // bottom up
    RegionId next_id = 1;
};

Json with_regions(const Parts& parts, const std::vector<RegionId>& order) {
    Json whole = parts.settings;
    whole["next_region_id"] = parts.next_id;
    Json& regions = whole["regions"] = Json::array();
    for (const RegionId id : order)
        regions.push_back(parts.regions.at(id));
    return whole;
}

// The errors of a project that has this region only; without one, of the project itself.
std::set<std::string> errors_of(const Json& settings, const Json* region) {
    Json whole = settings;
    whole["regions"] = Json::array();
    if (region) whole["regions"].push_back(*region);
    const auto project = project_from_json(whole.dump());
    if (!project) return {project.error().text()};
    std::set<std::string> out;
    // Without the region's name, which may have been changed, too.
    for (const Issue& issue : validate(*project))
        if (issue.severity == Severity::kError)
            out.insert(issue.what +
                       issue.where.substr(std::min(issue.where.rfind(": "), issue.where.size())));
    return out;
}

bool adds_errors(const Json& merged_settings, const Json* merged, const Json& mine_settings,
                 const Json* mine, const Json& theirs_settings, const Json* theirs) {
    const auto known = errors_of(mine_settings, mine), other = errors_of(theirs_settings, theirs);
    const auto now = errors_of(merged_settings, merged);
    return std::any_of(now.begin(), now.end(), [&](const std::string& error) {
        return !known.contains(error) && !other.contains(error);
    });
}

class ProjectMerge {
  public:
    ProjectMerge(Parts base, Parts mine, Parts theirs, MergeSide wins)
        : base_(std::move(base)),
          mine_(std::move(mine)),
          theirs_(std::move(theirs)),
          wins_(wins),
          merged_(Json{{"regions", Json::array()}, {"next_region_id", 1}}) {}

    Expected<MergedProject> run() {
        give_new_ids();
        merge_settings();
        for (const RegionId id : theirs_.order)
            merge_region(id);
        for (const RegionId id : mine_.order)
            if (!theirs_.find(id)) merge_region(id);
        tell_changes();
        const std::vector<RegionId> order = merged_order();
        give_free_names(order);
        WEFT_TRY(project, project_from_json(with_regions(merged_, order).dump()));
        out_.project = std::move(project);
        return std::move(out_);
    }

  private:
    void conflict(const std::string& region, std::string mine, std::string theirs) {
        out_.conflicts.push_back({region, "", {}, std::move(mine), std::move(theirs)});
    }
    [[nodiscard]] const Parts& winner() const {
        return wins_ == MergeSide::kMine ? mine_ : theirs_;
    }

    // Both added a region under the next free id: the one on the disk keeps it.
    void give_new_ids() {
        RegionId next = std::max({base_.next_id, mine_.next_id, theirs_.next_id});
        for (RegionId& id : mine_.order) {
            const Json* theirs = theirs_.find(id);
            if (base_.find(id) || !theirs || *theirs == *mine_.find(id)) continue;
            Json region = *mine_.find(id);
            region["id"] = next;
            mine_.regions.erase(id);
            mine_.regions.emplace(next, std::move(region));
            out_.renumbered.emplace(id, next);
            id = next++;
        }
        merged_.next_id = next;
    }

    void merge_settings() {
        std::vector<MergeConflict> conflicts;
        Json merged =
            merged_settings(base_.settings, mine_.settings, theirs_.settings, wins_, "", conflicts);
        if (adds_errors(merged, nullptr, mine_.settings, nullptr, theirs_.settings, nullptr)) {
            conflict("", "changed", "changed");
            merged = winner().settings;
        } else {
            out_.conflicts = std::move(conflicts);
        }
        merged_.settings = std::move(merged);
    }

    void merge_region(RegionId id) {
        const Json *base = base_.find(id), *mine = mine_.find(id), *theirs = theirs_.find(id);
        const Json* kept = nullptr;
        if (mine && theirs) {
            merged_.regions.emplace(id, merged_region(base, *mine, *theirs));
            return;
        }
        const Json* there = mine ? mine : theirs;
        if (!base) {
            kept = there;
        } else if (*there != *base) {
            conflict(name_of(*there), mine ? "changed" : "removed", mine ? "removed" : "changed");
            kept = (wins_ == MergeSide::kMine) == (mine != nullptr) ? there : nullptr;
        }
        if (kept) merged_.regions.emplace(id, *kept);
    }

    Json merged_region(const Json* base, const Json& mine, const Json& theirs) {
        static const Json kNone = Json::object();
        if (mine == theirs || (base && theirs == *base)) return mine;
        if (base && mine == *base) return theirs;
        std::vector<MergeConflict> conflicts;
        Json merged =
            merged_settings(base ? *base : kNone, mine, theirs, wins_, name_of(mine), conflicts);
        // Settings that are right one by one and wrong together: then one side as a whole.
        if (adds_errors(merged_.settings, &merged, mine_.settings, &mine, theirs_.settings,
                        &theirs)) {
            conflict(name_of(mine), "changed", "changed");
            return wins_ == MergeSide::kMine ? mine : theirs;
        }
        out_.conflicts.insert(out_.conflicts.end(), conflicts.begin(), conflicts.end());
        return merged;
    }

    void tell_changes() {
        if (theirs_.settings != base_.settings) out_.changed.emplace_back("the project");
        for (const RegionId id : theirs_.order) {
            const Json* base = base_.find(id);
            if (!base || *base != *theirs_.find(id))
                out_.changed.push_back(name_of(*theirs_.find(id)));
        }
        for (const RegionId id : base_.order)
            if (!theirs_.find(id)) out_.changed.push_back(name_of(*base_.find(id)));
    }

    // ---- the order of the layers ----
    // The order of one side, limited to regions that the base has, too.
    [[nodiscard]] std::vector<RegionId> known_order(const Parts& side, const Parts& other) const {
        std::vector<RegionId> out;
        for (const RegionId id : side.order)
            if (base_.find(id) && other.find(id)) out.push_back(id);
        return out;
    }

    [[nodiscard]] std::vector<RegionId> merged_order() {
        const auto mine = known_order(mine_, theirs_), theirs = known_order(theirs_, mine_);
        std::vector<RegionId> base;
        for (const RegionId id : base_.order)
            if (mine_.find(id) && theirs_.find(id)) base.push_back(id);
        const bool by_me = mine != base, by_them = theirs != base;
        const bool both = by_me && by_them && mine != theirs;
        if (both) out_.conflicts.push_back({"", "regions", {}, names(mine), names(theirs)});
        const bool take_mine = both ? wins_ == MergeSide::kMine : by_me;
        const Parts& first = take_mine ? mine_ : theirs_;
        const Parts& second = take_mine ? theirs_ : mine_;
        std::vector<RegionId> out;
        for (const RegionId id : first.order)
            if (merged_.find(id)) out.push_back(id);
        for (std::size_t k = 0; k < second.order.size(); ++k)
            if (merged_.find(second.order[k])) put_in_order(second.order, k, out);
        return out;
    }

    // Above the region that it lay on; on top if it was on top.
    static void put_in_order(const std::vector<RegionId>& order, std::size_t k,
                             std::vector<RegionId>& out) {
        const auto has = [&](RegionId id) {
            return std::find(out.begin(), out.end(), id) != out.end();
        };
        if (has(order[k])) return;
        if (std::none_of(order.begin() + static_cast<std::ptrdiff_t>(k), order.end(), has)) {
            out.push_back(order[k]);
            return;
        }
        auto place = out.begin();
        for (std::size_t below = k; below-- > 0;)
            if (const auto found = std::find(out.begin(), out.end(), order[below]);
                found != out.end()) {
                place = found + 1;
                break;
            }
        out.insert(place, order[k]);
    }

    [[nodiscard]] std::string names(const std::vector<RegionId>& order) const {
        std::string out;
        for (const RegionId id : order)
            out += (out.empty() ? "" : ", ") + name_of(*winner().find(id));
        return out;
    }

    // Commands find regions by their names: one that I added or renamed makes room.
    void give_free_names(const std::vector<RegionId>& order) {
        std::set<std::string> taken;
        const auto is_theirs = [&](RegionId id) {
            const Json* theirs = theirs_.find(id);
            return theirs && theirs->value("name", "") == merged_.regions.at(id).value("name", "");
        };
        for (const RegionId id : order)
            if (is_theirs(id)) taken.insert(merged_.regions.at(id).value("name", ""));
        for (const RegionId id : order) {
            if (is_theirs(id)) continue;
            const std::string wanted = merged_.regions.at(id).value("name", "");
            if (wanted.empty()) continue;
            std::string name = wanted;
            for (int number = 2; taken.contains(name); ++number)
                name = wanted + " " + std::to_string(number);
            if (name != wanted) merged_.regions.at(id)["name"] = name;
            taken.insert(name);
        }
    }

    const Parts base_;
    Parts mine_;
    const Parts theirs_;
    const MergeSide wins_;
    Parts merged_;
    MergedProject out_;
};

}  // namespace

Expected<MergedProject> merge_projects(const Project& base, const Project& mine,
                                       const Project& theirs, MergeSide wins) {
    WEFT_TRY(before, json_of(base));
    WEFT_TRY(ours, json_of(mine));
    WEFT_TRY(others, json_of(theirs));
    return ProjectMerge(Parts(std::move(before)), Parts(std::move(ours)), Parts(std::move(others)),
                        wins)
        .run();
}

}  // namespace weft

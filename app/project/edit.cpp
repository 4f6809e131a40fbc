#include "app/project/edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/project/parameter_entry.h"
#include "app/project/region_names.h"
#include "engine/core/frame_range.h"

namespace weft {
namespace {

std::string shown(const RegionRef& ref) {
    return ref.id != 0 ? std::to_string(ref.id) : ref.name;
}

Expected<std::size_t> index_of(const Project& project, const RegionRef& ref) {
    if (ref.id == 0) return find_region(project, ref.name);
    for (std::size_t i = 0; i < project.regions.size(); ++i)
        if (project.regions[i]->id == ref.id) return i;
    return fail(ErrorCode::kUsage, fmt::format("No region has the id {}", ref.id));
}

Status check_frame(int frame) {
    if (is_frame_number(frame)) return {};
    return fail(ErrorCode::kUsage, fmt::format("Frame {} is beyond {}, where frame numbers end",
                                               frame, kMaxFrameNumber));
}

/// The project with one region changed by `change(Region&) -> Status`.
template <class Change>
Expected<Project> with_region(const Project& project, const RegionRef& ref, Change&& change) {
    WEFT_TRY(index, index_of(project, ref));
    const Region& before = *project.regions[index];
    Region region = before;
    WEFT_CHECK_OK(change(region));
    const bool same_samples = region.texture.sample == before.texture.sample &&
                              region.texture.also == before.texture.also;
    if (!same_samples && region.amendments == before.amendments) region.amendments = {};
    Project out = project;
    out.regions[index] = std::move(region);
    return out;
}

/// Checks that all parameters are in range, for values that were not set one by one.
template <class Owner>
Status check_parameters(const Owner& owner, std::span<const Parameter<Owner>> table) {
    for (const Parameter<Owner>& parameter : table)
        WEFT_CHECK_OK(normalise(parameter, parameter.read(owner)));
    return {};
}

template <class Owner>
Status set_by_key(Owner& owner, std::span<const Parameter<Owner>> table, const std::string& key,
                  const ParameterValue& value) {
    WEFT_TRY(parameter, find_parameter(table, key));
    return set_parameter(owner, *parameter, value);
}

Expected<Project> apply_one(const Project& project, const SetPlate& edit) {
    Project out = project;
    out.plate = edit.plate;
    WEFT_CHECK_OK(check_parameters(out, project_parameters()));
    return out;
}

Expected<Project> apply_one(const Project& project, const SetOutput& edit) {
    Project out = project;
    out.output = edit.output;
    WEFT_CHECK_OK(check_parameters(out, project_parameters()));
    return out;
}

Expected<Project> apply_one(const Project& project, const SetProjectParameter& edit) {
    Project out = project;
    WEFT_CHECK_OK(set_by_key(out, project_parameters(), edit.key, edit.value));
    return out;
}

Expected<Project> apply_one(const Project& project, const AddRegion& edit) {
    WEFT_CHECK_OK(check_parameters(edit.region, region_parameters()));
    Region region = edit.region;
    if (region.id == 0) region.id = project.next_region_id;
    if (region.id == UINT32_MAX)
        return fail(ErrorCode::kUsage, "The project has used up its region ids", "start a new one");
    if (region_by_id(project, region.id))
        return fail(ErrorCode::kUsage,
                    fmt::format("There is a region with the id {} already", region.id),
                    "leave the id out");
    WEFT_CHECK_OK(check_name_is_free(project, region.id, region.name));
    const int count = static_cast<int>(project.regions.size());
    const int index = edit.index.value_or(count);
    if (index < 0 || index > count)
        return fail(ErrorCode::kUsage,
                    fmt::format("A new region's index is {}, but must be 0 to {}", index, count));
    Project out = project;
    out.next_region_id = std::max(out.next_region_id, region.id + 1);
    out.regions.insert(out.regions.begin() + index, Leaf<Region>(std::move(region)));
    return out;
}

Expected<Project> apply_one(const Project& project, const RemoveRegion& edit) {
    WEFT_TRY(index, index_of(project, edit.region));
    Project out = project;
    out.regions.erase(out.regions.begin() + static_cast<std::ptrdiff_t>(index));
    return out;
}

Expected<Project> apply_one(const Project& project, const MoveRegion& edit) {
    WEFT_TRY(from, index_of(project, edit.region));
    const int last = static_cast<int>(project.regions.size()) - 1;
    if (edit.index < 0 || edit.index > last)
        return fail(ErrorCode::kUsage,
                    fmt::format("A region's index is {}, but must be 0 to {}", edit.index, last));
    Project out = project;
    const Leaf<Region> region = out.regions[from];
    out.regions.erase(out.regions.begin() + static_cast<std::ptrdiff_t>(from));
    out.regions.insert(out.regions.begin() + edit.index, region);
    return out;
}

Expected<Project> apply_one(const Project& project, const SetRegionParameter& edit) {
    return with_region(project, edit.region, [&](Region& region) -> Status {
        WEFT_CHECK_OK(set_by_key(region, region_parameters(), edit.key, edit.value));
        if (edit.key != "name") return {};
        return check_name_is_free(project, region.id, region.name);
    });
}

Expected<Project> apply_one(const Project& project, const RenameRegion& edit) {
    return apply_one(project, SetRegionParameter{edit.region, "name", edit.name});
}

Expected<Project> apply_one(const Project& project, const SetMatte& edit) {
    return with_region(project, edit.region, [&](Region& region) -> Status {
        region.matte = edit.matte;
        return check_parameters(region, region_parameters());
    });
}

Expected<Project> apply_one(const Project& project, const SetMatteKeyframe& edit) {
    WEFT_CHECK_OK(check_frame(edit.frame));
    return with_region(project, edit.region, [&](Region& region) -> Status {
        if (!region.matte->files.empty())
            return fail(ErrorCode::kUsage,
                        fmt::format("The matte of region '{}' comes from the "
                                    "files '{}'",
                                    shown(edit.region), region.matte->files),
                        "set matte.files to nothing before giving it keyframes");
        if (!region.matte->shape.empty())
            return fail(
                ErrorCode::kUsage,
                fmt::format("The matte of region '{}' is drawn from a shape", shown(edit.region)),
                "remove matte.shape before giving it keyframes");
        if (edit.path.empty())
            return fail(ErrorCode::kUsage,
                        fmt::format("The matte keyframe of frame {} needs a path", edit.frame));
        region.matte = region.matte.with(
            [&](MatteSource& matte) { matte.keyframes[edit.frame].path = edit.path; });
        return {};
    });
}

Expected<Project> apply_one(const Project& project, const RemoveMatteKeyframe& edit) {
    return with_region(project, edit.region, [&](Region& region) -> Status {
        if (!region.matte->keyframes.contains(edit.frame) &&
            !region.matte->confirmed.contains(edit.frame))
            return fail(ErrorCode::kUsage,
                        fmt::format("Region '{}' has no matte keyframe on frame {}",
                                    shown(edit.region), edit.frame));
        region.matte = region.matte.with([&](MatteSource& matte) {
            matte.keyframes.erase(edit.frame);
            matte.confirmed.erase(edit.frame);
        });
        return {};
    });
}

Expected<Project> apply_one(const Project& project, const SetHoldouts& edit) {
    for (const MatteSource& holdout : edit.holdouts)
        WEFT_CHECK_OK(check_parameters(holdout, matte_parameters()));
    return with_region(project, edit.region, [&](Region& region) -> Status {
        region.holdouts = edit.holdouts;
        return {};
    });
}

Expected<Project> apply_one(const Project& project, const SetZones& edit) {
    for (const Zone& zone : edit.zones) {
        WEFT_CHECK_OK(check_parameters(zone, zone_parameters()));
        WEFT_CHECK_OK(check_parameters(zone.matte, matte_parameters()));
    }
    return with_region(project, edit.region, [&](Region& region) -> Status {
        region.zones = edit.zones;
        return {};
    });
}

Expected<Project> apply_one(const Project& project, const SetTexture& edit) {
    return with_region(project, edit.region, [&](Region& region) -> Status {
        region.texture = edit.texture;
        return check_parameters(region, region_parameters());
    });
}

Expected<Project> apply_one(const Project& project, const SetCorrection& edit) {
    WEFT_CHECK_OK(check_frame(edit.frame));
    for (const CorrectionPin& pin : edit.pins) {
        for (const double v : {pin.from.x, pin.from.y, pin.to.x, pin.to.y}) {
            if (!(std::abs(v) <= parameter_entry::kMaxPlatePx))
                return fail(ErrorCode::kUsage, fmt::format("A pin lies at {} px, but must lie "
                                                           "within {} px of the plate's corner",
                                                           v, parameter_entry::kMaxPlatePx));
        }
    }
    return with_region(project, edit.region, [&](Region& region) -> Status {
        region.corrections.erase(edit.frame);
        if (!edit.pins.empty()) region.corrections.emplace(edit.frame, edit.pins);
        return {};
    });
}

Expected<Project> apply_one(const Project& project, const SetAmendments& edit) {
    for (const PlaneAmendment& amendment : edit.amendments) {
        for (const TexelRun& run : amendment.runs) {
            if (run.count < 1 || (run.orientation != 0 && run.count != 1))
                return fail(ErrorCode::kUsage,
                            fmt::format("A run of texels has the length {}", run.count),
                            "it must be 1 or more, and 1 where the sample is turned");
        }
    }
    return with_region(project, edit.region, [&](Region& region) -> Status {
        region.amendments = edit.amendments;
        return {};
    });
}

std::string name_of_region(const Project& project, const RegionRef& ref) {
    const Region* region = ref.id != 0 ? region_by_id(project, ref.id) : nullptr;
    return region && !region->name.empty() ? region->name
           : ref.id != 0                   ? "region " + shown(ref)
                                           : ref.name;
}

}  // namespace

Expected<Project> apply_edit(const Project& project, const Edit& edit) {
    return std::visit([&](const auto& e) { return apply_one(project, e); }, edit);
}

Expected<Project> apply_edits(const Project& project, const std::vector<Edit>& edits) {
    Project out = project;
    for (std::size_t i = 0; i < edits.size(); ++i) {
        auto next = apply_edit(out, edits[i]);
        if (!next) return fail_in(std::move(next).error(), fmt::format("Action {}", i + 1));
        out = std::move(*next);
    }
    return out;
}

std::vector<Edit> region_edits(const Region& before, const Region& after) {
    const RegionRef ref{before.id, {}};
    std::vector<Edit> edits;
    // A matte is set as a whole, with its parameters.
    if (before.matte != after.matte) edits.emplace_back(SetMatte{ref, *after.matte});
    if (before.holdouts != after.holdouts) edits.emplace_back(SetHoldouts{ref, *after.holdouts});
    if (before.zones != after.zones) edits.emplace_back(SetZones{ref, *after.zones});
    for (const auto& [frame, pins] : before.corrections)
        if (!after.corrections.contains(frame)) edits.emplace_back(SetCorrection{ref, frame, {}});
    for (const auto& [frame, pins] : after.corrections) {
        const auto was = before.corrections.find(frame);
        if (was == before.corrections.end() || was->second != pins)
            edits.emplace_back(SetCorrection{ref, frame, pins});
    }
    for (const Parameter<Region>& parameter : region_parameters()) {
        const ParameterValue value = parameter.read(after);
        if (parameter.group != "matte" && value != parameter.read(before))
            edits.emplace_back(SetRegionParameter{ref, parameter.full_key(), value});
    }
    // Last, because changing the samples clears the amendments.
    if (before.amendments != after.amendments ||
        (before.texture != after.texture && !after.amendments->empty()))
        edits.emplace_back(SetAmendments{ref, *after.amendments});
    return edits;
}

std::string edit_label(const Project& before, const Edit& edit) {
    const auto region = [&](const RegionRef& ref) { return name_of_region(before, ref); };
    struct Label {
        const decltype(region)& name;
        std::string operator()(const SetPlate&) const { return "Set the plate"; }
        std::string operator()(const SetOutput&) const { return "Set the output"; }
        std::string operator()(const SetProjectParameter& e) const { return "Set " + e.key; }
        std::string operator()(const AddRegion& e) const {
            return "Add " + (e.region.name.empty() ? "a region" : e.region.name);
        }
        std::string operator()(const RemoveRegion& e) const { return "Remove " + name(e.region); }
        std::string operator()(const MoveRegion& e) const { return "Move " + name(e.region); }
        std::string operator()(const RenameRegion& e) const {
            return fmt::format("Rename {} to {}", name(e.region), e.name);
        }
        std::string operator()(const SetRegionParameter& e) const {
            return fmt::format("Set {} of {}", e.key, name(e.region));
        }
        std::string operator()(const SetMatte& e) const {
            return "Set the matte of " + name(e.region);
        }
        std::string operator()(const SetMatteKeyframe& e) const {
            return fmt::format("Matte keyframe {} of {}", e.frame, name(e.region));
        }
        std::string operator()(const RemoveMatteKeyframe& e) const {
            return fmt::format("Remove matte keyframe {} of {}", e.frame, name(e.region));
        }
        std::string operator()(const SetHoldouts& e) const {
            return "Set the holdouts of " + name(e.region);
        }
        std::string operator()(const SetZones& e) const {
            return "Set the zones of " + name(e.region);
        }
        std::string operator()(const SetCorrection& e) const {
            return fmt::format("{} {} of {}",
                               e.pins.empty() ? "Remove correction" : "Correct frame", e.frame,
                               name(e.region));
        }
        std::string operator()(const SetAmendments& e) const {
            return "Locked patches of " + name(e.region);
        }
        std::string operator()(const SetTexture& e) const {
            return "Set the texture of " + name(e.region);
        }
    };
    return std::visit(Label{region}, edit);
}

}  // namespace weft

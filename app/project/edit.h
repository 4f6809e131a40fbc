#pragma once
// Edits: the only ways to change a project. Panels, the command line and action files all emit
// these; apply_edit() is pure, so an undo is the project from before, and a list of edits can be
// replayed.

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/project/parameters.h"
#include "app/project/project.h"
#include "engine/core/error.h"

namespace weft {

/// A region by its id, or, where that is 0, by its name (as find_region() takes it). In JSON a
/// number or a text.
struct RegionRef {
    RegionId id = 0;
    std::string name;
    bool operator==(const RegionRef&) const = default;
};

struct SetPlate {
    Plate plate;
    bool operator==(const SetPlate&) const = default;
};
struct SetOutput {
    Output output;
    bool operator==(const SetOutput&) const = default;
};
/// Any entry of project_parameters() by its full key.
struct SetProjectParameter {
    std::string key;
    ParameterValue value;
    bool operator==(const SetProjectParameter&) const = default;
};
/// Without an id (0) it gets the next free one.
struct AddRegion {
    Region region;
    std::optional<int> index;  ///< Place among the layers, 0 at the bottom; unset: on top.
    bool operator==(const AddRegion&) const = default;
};
struct RemoveRegion {
    RegionRef region;
    bool operator==(const RemoveRegion&) const = default;
};
/// Its place afterwards: 0 at the bottom.
struct MoveRegion {
    RegionRef region;
    int index = 0;
    bool operator==(const MoveRegion&) const = default;
};
struct RenameRegion {
    RegionRef region;
    std::string name;
    bool operator==(const RenameRegion&) const = default;
};
/// Any entry of region_parameters() by its full key.
struct SetRegionParameter {
    RegionRef region;
    std::string key;
    ParameterValue value;
    bool operator==(const SetRegionParameter&) const = default;
};
struct SetMatte {
    RegionRef region;
    MatteSource matte;
    bool operator==(const SetMatte&) const = default;
};
/// Refused for a region whose matte comes from files.
struct SetMatteKeyframe {
    RegionRef region;
    int frame = 0;
    std::string path;
    bool operator==(const SetMatteKeyframe&) const = default;
};
struct RemoveMatteKeyframe {
    RegionRef region;
    int frame = 0;
    bool operator==(const RemoveMatteKeyframe&) const = default;
};
struct SetHoldouts {
    RegionRef region;
    std::vector<MatteSource> holdouts;
    bool operator==(const SetHoldouts&) const = default;
};
struct SetZones {
    RegionRef region;
    std::vector<Zone> zones;
    bool operator==(const SetZones&) const = default;
};
struct SetTexture {
    RegionRef region;
    TextureSource texture;
    bool operator==(const SetTexture&) const = default;
};

/// Puts the texture back in place on a frame; without pins the frame's correction goes.
struct SetCorrection {
    RegionRef region;
    int frame = 0;
    std::vector<CorrectionPin> pins;
    bool operator==(const SetCorrection&) const = default;
};

/// What of the region's grown texture is kept or made again.
struct SetAmendments {
    RegionRef region;
    std::vector<PlaneAmendment> amendments;
    bool operator==(const SetAmendments&) const = default;
};

using Edit =
    std::variant<SetPlate, SetOutput, SetProjectParameter, AddRegion, RemoveRegion, MoveRegion,
                 RenameRegion, SetRegionParameter, SetMatte, SetMatteKeyframe, RemoveMatteKeyframe,
                 SetHoldouts, SetZones, SetTexture, SetCorrection, SetAmendments>;

/// The project after the edit; the one before is untouched and shares what did not change. Errors:
/// Usage (no such region, frame or parameter; a value out of range). Pure, thread-safe.
[[nodiscard]] Expected<Project> apply_edit(const Project& project, const Edit& edit);
/// All of them in order, or the error of the first that fails ("Action 3: …").
[[nodiscard]] Expected<Project> apply_edits(const Project& project, const std::vector<Edit>& edits);

/// The edits that make the region `before` into `after`, which keeps its id.
[[nodiscard]] std::vector<Edit> region_edits(const Region& before, const Region& after);

/// What the edit does in a few words ("Set placement.scale of wall"), for the history list.
[[nodiscard]] std::string edit_label(const Project& before, const Edit& edit);

}  // namespace weft

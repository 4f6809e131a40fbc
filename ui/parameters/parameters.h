#pragma once
// The controls of parameters, by their keys.

#include <string>
#include <string_view>

#include "ui/base/ctx.h"

namespace weft::ui {

/// The control of one parameter of a region, from its table entry.
void region_parameter(Ctx& c, const Region& region, std::string_view key,
                      const char* label = nullptr);
/// The control of an animatable parameter; `keys` is the key of its keyframes.
void keyed_parameter(Ctx& c, const Region& region, std::string_view key, std::string_view keys,
                     const char* label = nullptr);
/// A parameter of the matte that is edited, the region's own, a holdout or a zone; with its keys
/// unless `keys` is empty.
void matte_parameter(Ctx& c, const Region& region, std::string_view key,
                     std::string_view keys = {});
/// A colour space control: built-in spaces or those of the OpenColorIO config. `usual`: the meaning
/// of an empty value.
void space_parameter(Ctx& c, std::string_view key, const char* label, const char* usual);
void project_parameter(Ctx& c, std::string_view key, const char* label = nullptr);
/// The label of a parameter by its full key, such as "Scale"; empty if it has none.
[[nodiscard]] std::string_view parameter_label(std::string_view key);
/// The same, or the readable key of a parameter without a label: "placement.corners_px" →
/// "Corners".
[[nodiscard]] std::string readable_label(std::string_view key);
/// The label of a choice: "Locked to the surface" for "locked"; without a label, its name.
[[nodiscard]] std::string choice_label(std::string_view key, std::string_view name);

/// The section for temporal parameters.
void time_section(Ctx& c, const Region& region);

}  // namespace weft::ui

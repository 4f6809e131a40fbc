#pragma once
// Parameters that are lists: names, keys over time, lamps, guides of form, and grid warps. Internal
// to parameter_values.cpp.

#include <string>

#include "app/project/parameters.h"

namespace weft::parameter_lists {

// Each accepts the typed value, command-line text (also in older files and in actions), or an empty
// list, which has no type yet. Errors: Usage, without the parameter's name.
[[nodiscard]] Expected<ParameterValue> names(const ParameterInfo& info, ParameterValue value);
[[nodiscard]] Expected<ParameterValue> keys(const ParameterInfo& info, ParameterValue value);
[[nodiscard]] Expected<ParameterValue> lamps(const ParameterInfo& info, ParameterValue value);
[[nodiscard]] Expected<ParameterValue> guides(const ParameterInfo& info, ParameterValue value);
[[nodiscard]] Expected<ParameterValue> warp(const ParameterInfo& info, ParameterValue value);

/// Formats a value of one of these kinds as command-line text.
[[nodiscard]] std::string text_of(const ParameterValue& value);

}  // namespace weft::parameter_lists

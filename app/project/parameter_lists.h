#pragma once
// The kinds of parameters that hold lists of their own: names, keys over time, lamps. Internal to
// parameter_values.cpp.

#include <string>

#include "app/project/parameters.h"

namespace weft::parameter_lists {

// Each takes the typed value, the text of the command line (also in older files and in actions), or
// an empty list, which has no type yet. Errors: Usage, without the parameter's name.
[[nodiscard]] Expected<ParameterValue> names(const ParameterInfo& info, ParameterValue value);
[[nodiscard]] Expected<ParameterValue> keys(const ParameterInfo& info, ParameterValue value);
[[nodiscard]] Expected<ParameterValue> lamps(const ParameterInfo& info, ParameterValue value);

/// The command line's text of a value of one of these kinds.
[[nodiscard]] std::string text_of(const ParameterValue& value);

}  // namespace weft::parameter_lists

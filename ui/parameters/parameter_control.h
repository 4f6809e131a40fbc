#pragma once
// The control of one entry of a parameter table, whoever has the value.

#include <functional>
#include <string>

#include "app/project/parameters.h"
#include "ui/base/ctx.h"

namespace weft::ui {

/// Called with a new value; `done`: false while the mouse still moves it.
using EmitValue = std::function<void(const ParameterValue& value, bool done)>;

/// The label of an entry: `given`, or what the table of controls calls it.
[[nodiscard]] std::string parameter_name(const ParameterInfo& info, const char* given = nullptr);
/// Draws the control.
void parameter_control(Ctx& c, const ParameterInfo& info, const ParameterValue& now,
                       const char* given, const EmitValue& emit);

}  // namespace weft::ui

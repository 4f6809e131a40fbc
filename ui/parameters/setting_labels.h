#pragma once
#include <string>

#include "engine/core/setting.h"

namespace weft::ui {

/// The editor's label of a setting: "Reference frames: 1012"; empty if it has none. A SettingNamer.
/// Thread-safe.
[[nodiscard]] std::string setting_label(const SettingRef& setting);

}  // namespace weft::ui

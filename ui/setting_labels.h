#pragma once
#include <string>

#include "engine/core/setting.h"

namespace weft::ui {

/// The editor's name of a setting, as its panels and menus have it: "Reference frames: 1012"; empty
/// where the editor has none. A SettingNamer. Thread-safe.
[[nodiscard]] std::string setting_label(const SettingRef& setting);

}  // namespace weft::ui

#pragma once
#include <string>

#include "engine/core/setting.h"

namespace weft {

/// The command-line name of a setting: "--reference-frame 1012", "'weft texture build'"; empty if
/// it has none. A SettingNamer. Thread-safe.
[[nodiscard]] std::string setting_flag(const SettingRef& setting);

}  // namespace weft

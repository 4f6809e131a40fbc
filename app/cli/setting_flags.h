#pragma once
#include <string>

#include "engine/core/setting.h"

namespace weft {

/// The command-line name of a setting: "--reference-frame 1012", "'weft texture build'"; empty if
/// it has none. A SettingNamer. Thread-safe.
[[nodiscard]] std::string setting_flag(const SettingRef& setting);

/// Returns true if the program that started this one composes messages from keys itself: the editor
/// names its own labels in the messages of its render jobs.
[[nodiscard]] bool names_settings_by_key();
/// "{light.strength}", "{reference_frames=1012}".
[[nodiscard]] std::string setting_in_braces(const SettingRef& setting);

}  // namespace weft

#pragma once
#include <string>

namespace weft {

/// The environment variable that makes a render job name settings in braces, as "{run.overwrite}"
/// or "{reference_frames=1012}".
inline constexpr const char* kSettingNamesVariable = "WEFT_SETTING_NAMES=keys";
/// The environment variable with the file into which a render job also writes what --json would
/// print in the end, for programs that did not start it.
inline constexpr const char* kAnswerFileVariable = "WEFT_ANSWER_FILE";

/// A job's message with the settings named in this program's terms: labels, not flags.
[[nodiscard]] std::string with_setting_names(const std::string& message);

}  // namespace weft

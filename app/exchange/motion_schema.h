#pragma once
#include <string>

namespace weft {

/// The JSON Schema (2020-12) of a motion export's "motion.json" and of what `weft motion` answers,
/// "weft.motion/1".
[[nodiscard]] std::string motion_schema_text();

}  // namespace weft

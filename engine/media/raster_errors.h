#pragma once
// Internal: what both decoders say and check alike.

#include <cstdint>
#include <string>

#include "engine/core/error.h"
#include "engine/core/geometry.h"

namespace weft {

/// "PATH cannot be read: REASON. WHAT TO DO"
[[nodiscard]] Error unreadable(const std::string& path, const std::string& reason,
                               const std::string& advice);
[[nodiscard]] Error damaged(const std::string& path, const std::string& reason);

/// Errors: NoSpace when a picture of this size cannot be held by this machine: better said than
/// killed by the system half way.
[[nodiscard]] Status check_memory(const std::string& path, Size size, int channels);

}  // namespace weft

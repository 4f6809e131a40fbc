#pragma once
// What a project or action file may be at most; more is refused before it can do harm. Internal.

#include <cstddef>

namespace weft {

inline constexpr std::size_t kMaxJsonBytes = std::size_t{32} << 20;
inline constexpr int kMaxJsonDepth = 32;
inline constexpr std::size_t kMaxJsonKeys = 4096;  ///< Of one object; lists have no such limit.

}  // namespace weft

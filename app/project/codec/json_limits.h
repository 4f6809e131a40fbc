#pragma once
// Limits of project and action files, checked while parsing to stop hostile input early. Internal.

#include <cstddef>

namespace weft {

inline constexpr std::size_t kMaxJsonBytes = std::size_t{32} << 20;
inline constexpr int kMaxJsonDepth = 32;
inline constexpr std::size_t kMaxJsonKeys = 4096;  ///< Keys of one object; lists have no limit.

}  // namespace weft

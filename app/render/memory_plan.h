#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/geometry.h"

namespace weft {

/// One part in so many of the memory that a job may use is for decoded plates.
inline constexpr std::size_t kCacheShare = 8;

/// How many frames of `size` may be rendered side by side within `memory_bytes` (0: no limit).
/// `layers`: each is written with EXR layers. Errors: NoSpace when not even one fits, saying how
/// much it takes.
[[nodiscard]] Expected<std::size_t> frames_at_once(Size size, std::int64_t memory_bytes,
                                                   bool layers);

/// What a render without a limit takes, with so many frames side by side.
[[nodiscard]] std::int64_t render_memory_bytes(Size size, std::size_t side_by_side, bool layers);

/// "3G", "800M", "1.5GiB", "2000000": bytes; K, M, G and T are powers of 1024. Errors: Usage.
[[nodiscard]] Expected<std::int64_t> parse_bytes(std::string_view text);

}  // namespace weft

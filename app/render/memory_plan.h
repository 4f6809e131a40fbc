#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/geometry.h"

namespace weft {

/// 1/kCacheShare of a job's memory limit is for decoded plates.
inline constexpr std::size_t kCacheShare = 8;

/// Number of frames of `size` that fit into `memory_bytes` in parallel (0: no limit). `layers`:
/// each has EXR layers. Errors: NoSpace when not even one fits; the message gives the memory
/// needed.
[[nodiscard]] Expected<std::size_t> frames_at_once(Size size, std::int64_t memory_bytes,
                                                   bool layers);

/// Memory of a render without a limit, with this many frames in parallel.
[[nodiscard]] std::int64_t render_memory_bytes(Size size, std::size_t side_by_side, bool layers);

/// Parses "3G", "800M", "1.5GiB" or "2000000" as bytes; K, M, G and T are powers of 1024. Errors:
/// Usage.
[[nodiscard]] Expected<std::int64_t> parse_bytes(std::string_view text);

}  // namespace weft

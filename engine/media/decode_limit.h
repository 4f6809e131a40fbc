#pragma once
#include <cstdint>

namespace weft {

/// The most memory for one decoded picture, as floats, in bytes: a quarter of the machine's memory
/// by default, because up to three copies exist while it is decoded. A larger picture is rejected
/// before any memory is allocated (NoSpace). For the whole process; thread-safe.
[[nodiscard]] std::int64_t decode_limit_bytes();
/// 0 restores the default.
void set_decode_limit_bytes(std::int64_t bytes);

}  // namespace weft

#pragma once
#include <cstdint>

namespace weft {

/// The most that one decoded picture may take, as floats, in bytes: a quarter of the machine's
/// memory unless set, because up to three copies are held while it is decoded. What claims more is
/// refused before any of it is allocated (NoSpace). For the whole process; safe from any thread.
[[nodiscard]] std::int64_t decode_limit_bytes();
/// 0: a quarter of the machine's memory again.
void set_decode_limit_bytes(std::int64_t bytes);

}  // namespace weft

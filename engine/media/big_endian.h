#pragma once
// Numbers in files with the most significant byte first.

#include <cstdint>

namespace weft {

/// The number in the four bytes at `from`, most significant first.
[[nodiscard]] inline std::uint32_t big_endian_u32(const unsigned char* from) {
    return std::uint32_t{from[0]} << 24 | std::uint32_t{from[1]} << 16 |
           std::uint32_t{from[2]} << 8 | std::uint32_t{from[3]};
}
inline void put_big_endian_u32(unsigned char* to, std::uint32_t value) {
    for (int i = 0; i < 4; ++i)
        to[i] = static_cast<unsigned char>(value >> (24 - 8 * i));
}

}  // namespace weft

#pragma once
// Internal: the piecewise sRGB curve (IEC 61966-2-1, 5.2), fast and bit-identical on every machine.

#include <span>

namespace weft {

/// In place, every value. The same results as srgb_to_linear() and linear_to_srgb().
void decode_srgb(std::span<float> values);
void encode_srgb(std::span<float> values);

}  // namespace weft

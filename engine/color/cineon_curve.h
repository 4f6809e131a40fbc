#pragma once
// Internal: the log curve of film scans, bit-identical on every machine.

#include <span>

namespace weft {

/// Kodak's Cineon curve (Kodak, "Grayscale transformations of Cineon digital film data", 1993): ten
/// bits of printing density in steps of 0.002, gamma 0.6; code 95 is black and code 685 is white (1
/// in linear light). A value is its code over 1023. Outside the codes the decoded curve continues:
/// below 0 along its tangent, above 1 unchanged. NaN and infinity stay. In place.
void decode_cineon(std::span<float> values);
void encode_cineon(std::span<float> values);

}  // namespace weft

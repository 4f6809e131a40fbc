#pragma once
// A network small enough to be written by hand: the mean colour of a picture, as ONNX.

#include <string>

namespace weft {

/// 1×3×side×side to 1×3: global average pooling and a flattening, in ONNX's protocol buffers (IR 7,
/// operators 11).
[[nodiscard]] std::string mean_colour_onnx(int side);

}  // namespace weft

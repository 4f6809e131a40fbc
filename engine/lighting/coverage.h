#pragma once
// What a matte's coverage says of a pixel.

namespace weft {

constexpr int kCoveredFrom = 128;  ///< The surface is visible from this coverage on.
constexpr int kUnmixedFrom = 250;  ///< Below this a pixel is a mixture.

}  // namespace weft

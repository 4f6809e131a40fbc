#pragma once

namespace weft {

/// Where the light on a new texture comes from.
enum class LightSource { kPlate, kNone, kPainted, kImage };

}  // namespace weft

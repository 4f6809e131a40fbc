#pragma once

namespace weft {

/// What lies beyond a texture plane's border.
enum class WrapMode { kRepeat, kMirror, kClamp };

}  // namespace weft

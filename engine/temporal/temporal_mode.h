#pragma once

namespace weft {

/// The temporal mode of a texture (method: "Temporal consistency").
enum class TemporalMode {
    kLocked,  ///< Texture coordinates follow the surface.
    kPaper,   ///< eq. 4–6: λ_t in the cut, then the α blend with the warped previous result.
    kNone     ///< Every frame synthesised by itself.
};

}  // namespace weft

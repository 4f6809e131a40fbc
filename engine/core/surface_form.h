#pragma once
#include <memory>

#include "engine/core/geometry.h"

namespace weft {

/// The shape of a surface as a texture sees it: where places of the reference frame come to lie
/// when the surface is laid flat without stretch. Immutable and thread-safe.
class SurfaceForm {
  public:
    virtual ~SurfaceForm() = default;
    /// The flat place of a place of the reference frame, both in unsqueezed pixels (PixelAspect);
    /// smooth, inside of the frame and beyond it.
    [[nodiscard]] virtual Vec2 flat(Vec2 unsqueezed) const = 0;
    /// The same form less pronounced: `share` from 0, flat, to 1, as it is.
    [[nodiscard]] virtual std::shared_ptr<const SurfaceForm> at_share(float share) const = 0;
};

}  // namespace weft

#pragma once
// Dense fields that travel between stages as plain values.

#include "engine/core/image.h"

namespace weft {

/// Motion in pixels. A field is named `target_from_source`: what lies at p in the source frame lies
/// at p + d(p) in the target frame. `valid` is 0 where the motion is unknown or occluded, else 255.
struct FlowField {
    ImageF2 d;
    Matte valid;

    FlowField() = default;
    explicit FlowField(Size s) : d(s), valid(s, 255) {}
    [[nodiscard]] Size size() const { return d.size(); }
    [[nodiscard]] bool empty() const { return d.empty(); }
};

/// Which way in time a file of true motion points.
enum class MotionDirection {
    kForward,  ///< later_from_earlier, on the earlier frame's pixels.
    kBackward  ///< earlier_from_later, on the later frame's pixels.
};

/// Which place of the texture plane each pixel shows, in texels (texel (i, j) has its centre at
/// (i + 0.5, j + 0.5)). `origin` is where the field's pixel (0, 0) lies on the plate.
struct TextureCoords {
    ImageF2 uv;
    Vec2i origin{0, 0};
    [[nodiscard]] Size size() const { return uv.size(); }
};

}  // namespace weft

#pragma once
// Compositing a frame on a device; the frame is transferred once each way.

#include <array>
#include <cstdint>
#include <optional>

#include "engine/compute/plane_pyramid.h"
#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

/// How finely a pixel's footprint on the plane is sampled.
enum class SampleQuality { kDraft, kFinal };

/// One frame's texture: every pixel whose matte is above 0 gets the mean of the plane over the
/// pixel's footprint, which is the parallelogram that the coordinates' Jacobian spans.
struct SampleRequest {
    const PlanePyramid* plane = nullptr;
    ViewF2 coords;   ///< H×W×2 texels of the plane (TextureCoords::uv).
    ViewU8x1 matte;  ///< H×W
    SampleQuality quality = SampleQuality::kFinal;
};

/// Shading gain in linear light: texture × (1 + strength (S / reference − 1)), within [least_gain,
/// most_gain].
struct GainRequest {
    ViewF1 shading;  ///< S, at 1/downscale of the frame.
    int downscale = 2;
    float reference = 1;
    float strength = 1;  ///< λ, 0–1; 0 changes nothing.
    float least_gain = 0.125f, most_gain = 8.0f;
};

/// One region of a frame: texture, light, composite O = F + M (T − B).
struct LayerRequest {
    SampleRequest texture;  ///< Coordinates and matte of the layer's box.
    Vec2i origin{0, 0};     ///< Where the box's pixel (0, 0) lies on the frame; it lies inside.
    ViewF3 old_surface;     ///< B, of the box's size; read where the matte is soft.
    std::array<float, 3> multiply{1, 1, 1};  ///< On the texture's R, G and B, before the light.
    std::optional<GainRequest> gain;
};

/// Layers are composited over the frame in the order in which they are added. Not thread-safe.
/// Unusable after an error: render the frame on the CPU.
class FrameCanvas {
  public:
    virtual ~FrameCanvas() = default;
    virtual Status add(const LayerRequest& layer) = 0;
    /// The present pixels of `rect`. Costs a transfer; needed where a layer lies over another one
    /// and B depends on both.
    virtual Status read(const Recti& rect, ImageView<float, 3> out) = 0;
    /// With a knee: rolls off above it, inside the union of the mattes, and returns how many pixels
    /// exceeded 1. Writes the pixels of the mattes to `out`, which has the frame's size; other
    /// pixels stay.
    virtual Expected<std::int64_t> finish(std::optional<float> knee, ImageView<float, 3> out) = 0;
};

}  // namespace weft

#pragma once
// Where the heavy operations run. The scalar CPU code is the truth; every other backend gives the
// same integers and pixels within 1/255.

#include <memory>
#include <string>

#include "engine/compute/plane_pyramid.h"
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

/// Operations on plain descriptors. Thread-safe: one backend serves many frames at a time.
class Backend {
  public:
    virtual ~Backend() = default;
    [[nodiscard]] virtual std::string name() const = 0;         ///< As in --backend.
    [[nodiscard]] virtual std::string description() const = 0;  ///< Device, for the report.
    /// `out`: H×W×3, in the pyramid's space; pixels with matte 0 are left as they are.
    virtual void sample_plane(const SampleRequest& request, ImageView<float, 3> out) const = 0;
};

}  // namespace weft

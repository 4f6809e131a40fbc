#pragma once
// The ideally moved texture: what a renderer without any error of motion or filtering would show.
// It gives sharpness its reference and the TDE its floor (method.md, 7).

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/core/texture_mapping.h"
#include "engine/metrics/kernels.h"

namespace weft {

/// The reference filter: each pixel is the plain mean over its area of samples_per_axis² lookups of
/// the plane with `kernel`, the area mapped to the plane by the local affine part of the motion
/// and the placement. Where a pixel covers more than samples_per_axis / 2 texels along an axis,
/// more samples are taken (at most 64 an axis), so a minified texture does not alias.
struct IdealFilter {
    Kernel kernel = Kernel::kCatmullRom;
    int samples_per_axis = 8;
    /// Average in linear light instead of on encoded (sRGB) values.
    bool linear_light = false;
};

/// A texture plane that repeats without end, ready to be rendered many times. Immutable; render
/// calls may run in several threads.
class IdealTexture {
  public:
    /// `plane`: encoded RGB, H×W×3, at least 1×1.
    explicit IdealTexture(ViewU8x3 plane, IdealFilter filter = {});

    /// Renders the plane at the size of `ref_from_cur`. That field says where each pixel of this
    /// frame lies on the reference frame; `mapping` takes those places to texels. Encoded RGB, 1.0
    /// = white, not clipped, 0 where the field is not valid.
    [[nodiscard]] ImageF3 render(const FlowField& ref_from_cur,
                                 const TextureMapping& mapping) const;

    /// The luma of render() in 8-bit units (see luma_8bit()), at a third of the cost when the
    /// average is taken on encoded values. 0 where the field is not valid.
    [[nodiscard]] ImageF1 render_luma(const FlowField& ref_from_cur,
                                      const TextureMapping& mapping) const;

  private:
    IdealFilter filter_;
    Size size_;
    ImageF3 rgb_;   // The plane in the space of the average, with kBorder texels of wrap around it.
    ImageF1 luma_;  // Its luma, likewise; empty when the average is in linear light.
};

/// The field of the reference frame itself: nothing has moved; valid where `matte` is inside.
[[nodiscard]] FlowField reference_field(ViewU8x1 matte);

}  // namespace weft

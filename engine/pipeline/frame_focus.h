#pragma once
#include "engine/pipeline/frame_light.h"

namespace weft {

/// Whether the texture's own sharpness is measured once for a shot; otherwise it is measured on
/// every frame (a texture that differs from frame to frame, and one that a UV pass places).
[[nodiscard]] bool is_focus_followed(const RegionPlan& region);
/// Measures it on the reference frame, of which `extent` is the region's matte. Needs the scene's
/// plane, mapping and exposure.
void take_texture_focus(const ShotPlan& plan, const RegionPlan& region, const Matte& extent,
                        RegionScene& scene);

/// Blurs a region's texture over its box as the plate is blurred there, times the region's focus
/// (method: "Grain and focus"). `inside`: the matte over the box. Errors: those of the source and
/// the store.
[[nodiscard]] Status match_focus(const FrameLight& light, ViewU8x1 inside, ImageF3& texture);

}  // namespace weft

#pragma once
#include <vector>

#include "engine/media/exr_frame.h"
#include "engine/pipeline/frame_layers.h"
#include "engine/pipeline/layer_kind.h"

namespace weft {

/// The layers as channels of an EXR (docs/FORMATS.md): patch.RGBA, edge.RGB, light.RGB,
/// st.RG (32 bit), matte.A, seam.A, id.Y (32 bit), texture.RGB, finish.RGB (32 bit), normal.xyz,
/// depth.Z (32 bit), form_confidence.A. The last three need FrameLayers::form.
[[nodiscard]] std::vector<ExrLayer> exr_layers(const FrameLayers& layers,
                                               const std::vector<LayerKind>& kinds);

}  // namespace weft

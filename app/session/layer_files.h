#pragma once
#include <string>
#include <vector>

#include "engine/media/exr_frame.h"
#include "engine/pipeline/frame_layers.h"

namespace weft {

/// "patch,st" or "all". Errors: Usage, listing the names.
[[nodiscard]] Expected<std::vector<std::string>> parse_layer_names(const std::string& text);

/// The named layers as channels of an EXR (docs/FORMATS.md): patch.RGBA, edge.RGB, light.RGB,
/// st.RG (32 bit), matte.A, seam.A, id.Y (32 bit).
[[nodiscard]] std::vector<ExrLayer> exr_layers(const FrameLayers& layers,
                                               const std::vector<std::string>& names);

}  // namespace weft

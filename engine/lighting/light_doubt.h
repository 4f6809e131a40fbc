#pragma once
// Where light and paint may have been taken for each other.

#include "engine/lighting/shading.h"

namespace weft {

/// What is neither fine, and so paint, nor wide, and so light, and what no colour has decided: the
/// local amplitude of it in what was taken for light, plus that in what was taken for paint (ln
/// units). Either may belong to the other. `light` and `paint`: ln light and ln reflectance,
/// without the parts that colours tell; `weight`: confidence, 0 where unknown; `pattern_px`: in
/// pixels of these planes. Thread-safe.
[[nodiscard]] ImageF1 light_doubt(const ImageF1& light, const ImageF1& paint, const ImageF1& weight,
                                  float pattern_px);

/// The same of a single frame's shading; what is printed on its ground is decided, too.
[[nodiscard]] ImageF1 light_doubt(const SurfaceSample& sample, const LogShading& log,
                                  const ShadingOptions& options);

/// Sets Shading::sure. `doubt`: over the sample's box.
void note_doubt(Shading& shading, const SurfaceSample& sample, const ImageF1& doubt);

}  // namespace weft

#pragma once
// Straight and associated (premultiplied) colours.

#include <memory>

#include "engine/core/image.h"

namespace weft {

/// How a picture's colours relate to its alpha. Associated colours are multiplied by it, as an EXR
/// holds them; straight ones are not, as a PNG holds them (Porter & Duff 1984).
enum class AlphaKind { kStraight, kAssociated };

/// The alpha of a plate's frame.
struct PlateAlpha {
    std::shared_ptr<const ImageF1> coverage;  ///< H×W, 0–1; null: opaque.
    AlphaKind kind = AlphaKind::kStraight;    ///< Of the plate's colours.

    [[nodiscard]] bool associated() const { return coverage && kind == AlphaKind::kAssociated; }
};

/// True if any pixel of `alpha` is above 0. An alpha of nothing but 0 is one that was never made:
/// the picture is opaque.
[[nodiscard]] bool has_coverage(ViewF1 alpha);

/// Straight colours become associated ones: rgb · alpha. Both H×W. A colour under alpha 0, which
/// shows nowhere, becomes 0. Without coverage nothing changes.
void associate(ImageView<float, 3> rgb, ViewF1 alpha);
/// The way back: rgb / alpha. Where alpha is 0, associated colours are light without a body (a
/// glow), and stay as they are; so do all without coverage.
void unassociate(ImageView<float, 3> rgb, ViewF1 alpha);
/// One row of it, without the test for coverage.
void unassociate_row(float* rgb, const float* alpha, int width);

}  // namespace weft

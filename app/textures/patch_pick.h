#pragma once
// Finds the texels of a synthesized texture at a place in the picture, for locking and regenerating
// patches.

#include <cstddef>
#include <optional>
#include <vector>

#include "app/textures/provenance.h"
#include "engine/synthesis/plane_amendment.h"

namespace weft {

/// The patch at a plate pixel, up to its seams. Nothing if the texture is not synthesized. Takes
/// well under 1 ms.
[[nodiscard]] std::optional<PlaneAmendment> patch_at(const Provenance& from, Vec2 plate_pixel);

/// A square of texels around a plate pixel, `reach` on each side: a seam with the parts that it
/// joins.
[[nodiscard]] std::optional<PlaneAmendment> seam_at(const Provenance& from, Vec2 plate_pixel,
                                                    int reach = 24);

/// Numbers the patches of a synthesized plane from 1 in row order; texels that show neighbouring
/// sample pixels form a patch. Same size as the plane.
[[nodiscard]] Image<std::int32_t, 1> number_patches(const PlaneMap& map);

/// All texels in a rectangle of the plate, at most 512 × 512 around its centre.
[[nodiscard]] std::optional<PlaneAmendment> places_in(const Provenance& from, Vec2 a, Vec2 b);

/// The amendment that contains this plate pixel; the last one if there are several.
[[nodiscard]] std::optional<std::size_t> amendment_at(const std::vector<PlaneAmendment>& amendments,
                                                      const Provenance& from, Vec2 plate_pixel);

}  // namespace weft

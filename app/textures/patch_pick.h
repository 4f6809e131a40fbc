#pragma once
// From a place on the picture to places of the grown texture: what an artist keeps or has made
// again.

#include <cstddef>
#include <optional>
#include <vector>

#include "app/textures/provenance.h"
#include "engine/synthesis/plane_amendment.h"

namespace weft {

/// The piece of the sample that shows at a plate pixel, up to its seams. Nothing where the texture
/// is not grown. Takes well under a millisecond.
[[nodiscard]] std::optional<PlaneAmendment> patch_at(const Provenance& from, Vec2 plate_pixel);

/// A square of texels around a plate pixel, `reach` to each side: a seam with what it joins.
[[nodiscard]] std::optional<PlaneAmendment> seam_at(const Provenance& from, Vec2 plate_pixel,
                                                    int reach = 24);

/// Numbers the patches of a grown plane, from 1 in the order in which rows meet them: texels that
/// show neighbours of one sample belong together. As large as the plane.
[[nodiscard]] Image<std::int32_t, 1> number_patches(const PlaneMap& map);

/// All texels that lie in a rectangle of the plate, at most 512 × 512 around its middle.
[[nodiscard]] std::optional<PlaneAmendment> places_in(const Provenance& from, Vec2 a, Vec2 b);

/// Which of the amendments reaches to this plate pixel; of several the last.
[[nodiscard]] std::optional<std::size_t> amendment_at(const std::vector<PlaneAmendment>& amendments,
                                                      const Provenance& from, Vec2 plate_pixel);

}  // namespace weft

#pragma once
#include <utility>

#include "engine/core/texture_mapping.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// Where the places of one frame lie on a region's surface: followed to the reference frame, laid
/// flat by the form, seen squarely by the corners. There the placement's scale, rotation and offset
/// act. Immutable and thread-safe.
class SurfacePlaces {
  public:
    /// `ground`: the region's mapping without scale, rotation and offset.
    SurfacePlaces(LatticeField ref_from_cur, TextureMapping ground)
        : ref_from_cur_(std::move(ref_from_cur)), ground_(std::move(ground)) {}
    [[nodiscard]] Vec2 at(Vec2 plate) const {
        return ground_.texel(plate + ref_from_cur_.at(plate));
    }

  private:
    LatticeField ref_from_cur_;
    TextureMapping ground_;
};

}  // namespace weft

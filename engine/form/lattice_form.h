#pragma once
#include <utility>

#include "engine/core/surface_form.h"
#include "engine/form/form_map.h"

namespace weft {

/// A form on a lattice, as flat_from_reference() finds it.
class LatticeForm final : public SurfaceForm {
  public:
    /// `amount`: 0 leaves the surface flat, 1 lays it as found.
    LatticeForm(FormMap flat_from_reference, float amount)
        : map_(std::move(flat_from_reference)), amount_(amount) {}
    [[nodiscard]] Vec2 flat(Vec2 pixel) const override { return pixel + amount_ * map_.at(pixel); }

  private:
    FormMap map_;
    float amount_;
};

}  // namespace weft

#pragma once
#include <utility>

#include "engine/core/surface_form.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// A form on a lattice, as flat_from_reference() finds it.
class LatticeForm final : public SurfaceForm {
  public:
    /// `amount`: 0 leaves the surface flat, 1 lays it as found.
    LatticeForm(LatticeField flat_from_reference, float amount)
        : field_(std::move(flat_from_reference)), amount_(amount) {}
    [[nodiscard]] Vec2 flat(Vec2 pixel) const override {
        return pixel + amount_ * field_.at(pixel);
    }

  private:
    LatticeField field_;
    float amount_;
};

}  // namespace weft

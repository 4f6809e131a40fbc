#pragma once
#include <memory>
#include <utility>

#include "engine/core/surface_form.h"
#include "engine/form/form_map.h"

namespace weft {

/// A form on a lattice, as flat_from_reference() finds it.
class LatticeForm final : public SurfaceForm {
  public:
    /// `amount`: 0 leaves the surface flat, 1 lays it as found.
    LatticeForm(FormMap flat_from_reference, float amount)
        : LatticeForm(std::make_shared<const FormMap>(std::move(flat_from_reference)), amount) {}
    LatticeForm(std::shared_ptr<const FormMap> flat_from_reference, float amount)
        : map_(std::move(flat_from_reference)), amount_(amount) {}
    [[nodiscard]] Vec2 flat(Vec2 unsqueezed) const override {
        return unsqueezed + amount_ * map_->at(unsqueezed);
    }
    [[nodiscard]] std::shared_ptr<const SurfaceForm> at_share(float share) const override {
        return std::make_shared<LatticeForm>(map_, amount_ * share);
    }

  private:
    std::shared_ptr<const FormMap> map_;
    float amount_;
};

}  // namespace weft

#pragma once
// Internal to zone_motion: a field that becomes another one inside of a zone, with a fixed
// boundary.

#include <functional>

#include "engine/temporal/zone_motion.h"

namespace weft {

/// The nodes that a zone changes and those that hold them. Refers to the field and the zone.
class ZoneSolve {
  public:
    ZoneSolve(const LatticeField& field, const MotionZone& zone);

    /// Whether no node changes.
    [[nodiscard]] bool empty() const { return free_.empty(); }
    /// Whether the surface around the zone holds it anywhere.
    [[nodiscard]] bool is_held() const { return held_; }

    /// The field with that of `guide` (displacement at a place, px) inside: with v the difference
    /// of the two, least Σ (vᵢ − vⱼ)² over neighbouring nodes + Σ vᵢ² / reach², where v is given on
    /// the boundary (the membrane of Pérez et al. 2003, eq. 3, screened). `reach`: over how many
    /// nodes what the boundary says fades out; 0: it reaches everywhere.
    [[nodiscard]] LatticeField towards(const std::function<Vec2(Vec2)>& guide, double reach) const;

    /// Calls visit(p) for places of the surface on a grid of half the lattice's spacing: inside of
    /// the zone, or outside of it, at most `around` spacings away from where it acts.
    void each_inside(const std::function<void(Vec2)>& visit) const;
    void each_around(int around, const std::function<void(Vec2)>& visit) const;

  private:
    [[nodiscard]] std::size_t at(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(size_.width) +
               static_cast<std::size_t>(i);
    }
    void each_place(const std::function<void(Vec2, bool in_zone)>& visit) const;

    const LatticeField& field_;
    const MotionZone& zone_;
    Size size_;                                           // of the lattice
    std::vector<std::uint8_t> zone_near_, surface_near_;  // the largest coverage nearby
    std::vector<Vec2i> free_;
    bool held_ = false;
};

}  // namespace weft

#pragma once
// The one lattice on which all patches of a periodic sample lie on a plane.

#include <optional>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/core/image.h"
#include "engine/synthesis/sample_lattice.h"

namespace weft {

/// Of a plane, px.
inline constexpr int kLargestPlaneSide = 16384;

/// A sample's lattice on a plane, with a point at texel (0, 0). On a torus it is strained so that
/// both sides are whole numbers of periods. Offsets of patches (plane less sample position) lie on
/// it, rounded to texels.
class PlaneLattice {
  public:
    PlaneLattice() = default;
    explicit PlaneLattice(const SampleLattice& sample, std::optional<Size> torus = std::nullopt);

    [[nodiscard]] bool empty() const { return count_ == 0; }
    [[nodiscard]] int count() const { return count_; }
    [[nodiscard]] const LatticeWaves& waves() const { return waves_; }
    /// How far the strained lattice moves from the sample's per pixel, at most: 0.01 is a pixel in
    /// a hundred.
    [[nodiscard]] double strain() const { return strain_; }
    /// How far patches may lie from the lattice: to the nearest texel, or as far as the sample's
    /// own repeats do.
    [[nodiscard]] double tolerance_px() const { return tolerance_px_; }

    /// From an offset to the nearest point of the lattice, in pixels.
    [[nodiscard]] glm::dvec2 miss(glm::dvec2 offset) const;
    /// Whether an offset lies within the tolerance; always without a lattice.
    [[nodiscard]] bool holds(Vec2i offset) const;
    /// One byte for each of the offsets first + (x, y): 1 within the tolerance of the lattice.
    [[nodiscard]] Image<std::uint8_t, 1> held(Vec2i first, Size size) const;
    /// Sizes of rectangles of offsets that hold a point of the lattice wherever they lie.
    [[nodiscard]] std::vector<Size> covers() const;

  private:
    int count_ = 0;
    LatticeWaves waves_{};
    std::array<glm::dvec2, 2> steps_{};
    double strain_ = 0, tolerance_px_ = 0;
};

/// The size of a torus of whole periods: the smallest of at least `least` whose strain is below
/// 0.25 %, or, where none of up to an eighth more is, the one of least strain. `least` without a
/// lattice.
[[nodiscard]] Size whole_periods(const SampleLattice& lattice, Size least);

}  // namespace weft

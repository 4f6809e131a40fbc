#pragma once
// The lattice of a periodic sample: courses of bricks, tiles, tartan, a printed repeat.

#include <array>
#include <glm/vec2.hpp>

#include "engine/core/image.h"
#include "engine/synthesis/texture_period.h"

namespace weft {

/// Translations that map a texture onto itself: all whole combinations of `steps`. With one step
/// (planks, stripes) any move along the stripes belongs to them too; the step is then the normal of
/// the stripes.
struct SampleLattice {
    int count = 0;                      ///< Steps in use: 0 (no lattice), 1 or 2.
    std::array<glm::dvec2, 2> steps{};  ///< In pixels, to a fraction of one; reduced.
    /// How much more the sample resembles itself moved by the lattice than moved by half a step: 0
    /// for a texture without a period, near 1 for an exact print.
    double confidence = 0;
    double match = 0;        ///< Mean correlation of the sample with itself moved by the lattice.
    int repeats = 0;         ///< Moves by the lattice within half the sample, the evidence.
    double residual_px = 0;  ///< Of the sample's own repeats from the lattice, root mean square.
    bool operator==(const SampleLattice&) const = default;
};

/// Wave vectors: `waves[k]` times a translation is whole for all k if and only if the translation
/// belongs to the lattice.
using LatticeWaves = std::array<glm::dvec2, 2>;
[[nodiscard]] LatticeWaves waves_of(const SampleLattice& lattice);
[[nodiscard]] std::array<glm::dvec2, 2> steps_of(const LatticeWaves& waves, int count);
/// The shortest steps of the same lattice (Lagrange), the shorter first.
[[nodiscard]] std::array<glm::dvec2, 2> reduced(std::array<glm::dvec2, 2> steps);

/// The sample's lattice, without steps if there is none: steps of at least 6 px and at most half
/// the sample (of a large one its middle 512 px). `self` is self_mismatch() of the same sample.
/// Thread-safe.
[[nodiscard]] SampleLattice find_lattice(ViewU8x3 sample, const SelfMismatch& self);
[[nodiscard]] SampleLattice find_lattice(ViewU8x3 sample);

}  // namespace weft

#pragma once
// What a lattice must stand before a plane is laid on it: that it is made of whole units.

#include <array>
#include <optional>

#include "engine/synthesis/sample_lattice.h"
#include "engine/synthesis/self_correlation.h"

namespace weft {

/// True if moves along stripes are alike at the first step across them. Courses of bricks and rows
/// of stitches are stripes with joints: there they are not.
[[nodiscard]] bool is_free_along(const SelfCorrelation& c, double step_px, bool along_x);

/// Courses `step_px` apart that are not free along themselves: the lattice of the joints within
/// them, in line or shifted by half from course to course, or in line with every second course.
/// None where the joints do not stand out.
[[nodiscard]] std::optional<std::array<glm::dvec2, 2>> joints_in_courses(const SelfCorrelation& c,
                                                                         double step_px,
                                                                         bool along_x);

/// A lattice of two steps, made coarser while every second or third of its translations matches
/// clearly better than the others, which then are half a unit off: stretchers over headers, a tile
/// of the other colour.
[[nodiscard]] std::array<glm::dvec2, 2> whole_units(const SelfCorrelation& c,
                                                    std::array<glm::dvec2, 2> steps);

/// True if the lattice of reduced steps has a mirror: rectangles or courses with a half offset. One
/// of parts of units has none, save by chance.
[[nodiscard]] bool is_symmetric(const std::array<glm::dvec2, 2>& steps);

/// True if no translation of the lattice matches much less than the others do.
[[nodiscard]] bool is_even(const SelfCorrelation& c, const std::array<glm::dvec2, 2>& steps);

}  // namespace weft

#include "engine/synthesis/sample_lattice.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace weft {
namespace {

double area_between(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

// The inverse transpose: its rows times the steps are the unit matrix.
std::array<glm::dvec2, 2> dual(const std::array<glm::dvec2, 2>& v, int count) {
    if (count == 0) return {};
    if (count == 1) return {v[0] / glm::dot(v[0], v[0]), {}};
    const double det = area_between(v[0], v[1]);
    return {glm::dvec2{v[1].y, -v[1].x} / det, glm::dvec2{-v[0].y, v[0].x} / det};
}

}  // namespace

LatticeWaves waves_of(const SampleLattice& lattice) {
    return dual(lattice.steps, lattice.count);
}

std::array<glm::dvec2, 2> steps_of(const LatticeWaves& waves, int count) {
    return dual(waves, count);
}

std::array<glm::dvec2, 2> reduced(std::array<glm::dvec2, 2> s) {
    for (int turns = 0; turns < 64; ++turns) {
        if (glm::dot(s[1], s[1]) < glm::dot(s[0], s[0])) std::swap(s[0], s[1]);
        const double times = std::round(glm::dot(s[0], s[1]) / glm::dot(s[0], s[0]));
        if (times == 0) break;
        s[1] -= times * s[0];
    }
    return s;
}

}  // namespace weft

#include "engine/form/flat_plane.h"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "engine/form/flat_places.h"
#include "engine/form/unit_vector.h"

namespace weft {
namespace {

// Two directions at right angles on the plane, the first as level as can be in the picture.
std::pair<glm::dvec3, glm::dvec3> directions_on(const glm::dvec3& normal) {
    const glm::dvec3 n = unit(normal);
    const glm::dvec3 across = std::abs(n.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 x = unit(glm::cross(across, n));
    return {x, glm::cross(n, x)};
}

// The depth: 1 / ρ, which goes on along its tangent from the least ρ.
double depth_of(double nearness, double least) {
    return nearness >= least ? 1 / nearness : (2 - nearness / least) / least;
}

}  // namespace

double SeenPlane::nearness(Vec2 place) const {
    return glm::dot(normal, camera.ray(place));
}

FormMap flat_plane(const SeenPlane& plane, double least_nearness, const MetricField& field) {
    const auto [along_x, along_y] = directions_on(plane.normal);
    const float half = 0.5f * static_cast<float>(field.spacing());
    std::vector<glm::dvec2> flat;
    flat.reserve(static_cast<std::size_t>(field.cells().width + 1) *
                 static_cast<std::size_t>(field.cells().height + 1));
    for (int j = 0; j <= field.cells().height; ++j) {
        for (int i = 0; i <= field.cells().width; ++i) {
            const Vec2 node = field.centre_of(i, j) - Vec2(half, half);
            const glm::dvec3 place =
                depth_of(plane.nearness(node), least_nearness) * plane.camera.ray(node);
            flat.emplace_back(glm::dot(along_x, place), glm::dot(along_y, place));
        }
    }
    return form_of_places(field, std::move(flat));
}

}  // namespace weft

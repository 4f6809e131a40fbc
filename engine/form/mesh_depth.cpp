#include "engine/form/mesh_depth.h"

#include <Eigen/Dense>
#include <cmath>

#include "engine/form/eigen_types.h"
#include "engine/form/view_camera.h"

namespace weft {
namespace {

constexpr std::size_t kFewestSeen = 8;
constexpr double kStiff = 1e-9;  // a plane leaves one of the four numbers open

}  // namespace

std::vector<glm::dvec3> places_in_space(const FormMap& form, const std::vector<Vec2>& pixels,
                                        Size picture) {
    const ViewCamera camera =
        camera_with(static_cast<double>(form.relief_fov_deg), form.aspect.unsqueezed(picture));
    std::vector<glm::dvec3> out;
    out.reserve(pixels.size());
    for (const Vec2 plate : pixels) {
        const Vec2 pixel = form.aspect.unsqueezed(plate);
        // Long double: see docs/decisions/0002-determinism.md.
        const auto depth = static_cast<double>(
            std::exp(static_cast<long double>(form.relief.at(pixel - form.origin).x)));
        out.push_back(depth * camera.ray(pixel));
    }
    return out;
}

std::vector<double> depths_of(const std::vector<SeenCorner>& corners) {
    Matrix4 normal = Matrix4::Zero();
    Vector4 right = Vector4::Zero();
    std::size_t seen = 0;
    for (const SeenCorner& corner : corners) {
        if (!(corner.depth > 0)) continue;
        const Vector4 row(corner.place.x, corner.place.y, corner.place.z, 1);
        normal += row * row.transpose();
        right += corner.depth * row;
        ++seen;
    }
    if (seen < kFewestSeen) return {};
    normal.diagonal().array() += kStiff * normal.trace();
    const Vector4 map = normal.ldlt().solve(right);
    std::vector<double> out;
    out.reserve(corners.size());
    for (const SeenCorner& corner : corners)
        out.push_back(corner.depth > 0
                          ? corner.depth
                          : map.dot(Vector4(corner.place.x, corner.place.y, corner.place.z, 1)));
    return out;
}

}  // namespace weft

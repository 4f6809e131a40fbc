#include "engine/temporal/placement.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "engine/core/parallel.h"

namespace weft {
namespace {

// Columns, as GLM keeps them: the map (u, v) → (a u + c v + tx, b u + d v + ty).
Mat3 affine(float a, float b, float c, float d, Vec2 t) {
    return {a, b, 0, c, d, 0, t.x, t.y, 1};
}

// The homography of the unit square onto four corners in order (Heckbert 1989, eq. 2.9–2.11).
Mat3 square_to_quad(const std::array<Vec2, 4>& q) {
    const Vec2 d1 = q[1] - q[2], d2 = q[3] - q[2], s = q[0] - q[1] + q[2] - q[3];
    const float den = d1.x * d2.y - d2.x * d1.y;
    const float g = (s.x * d2.y - d2.x * s.y) / den;
    const float h = (d1.x * s.y - s.x * d1.y) / den;
    const Vec2 u = q[1] - q[0] + g * q[1], v = q[3] - q[0] + h * q[3];
    return {u.x, u.y, g, v.x, v.y, h, q[0].x, q[0].y, 1};
}

bool convex(const std::array<Vec2, 4>& q) {
    int positive = 0, negative = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec2 a = q[(k + 1) % 4] - q[k], b = q[(k + 2) % 4] - q[(k + 1) % 4];
        const float cross = a.x * b.y - a.y * b.x;
        positive += cross > 1e-3f;
        negative += cross < -1e-3f;
    }
    return positive == 4 || negative == 4;
}

}  // namespace

Expected<Mat3> plane_from_plate(const PlanePlacement& p) {
    if (!(p.scale > 0) || !std::isfinite(p.scale)) {
        return fail(ErrorCode::kUsage, "The scale must be above 0.");
    }
    // Counter-clockwise on a screen whose y points down.
    const float angle = glm::radians(p.rotate_deg);
    const float c = std::cos(angle), s = std::sin(angle);
    if (!p.corners) {
        return glm::inverse(
            affine(p.scale * c, -p.scale * s, p.scale * s, p.scale * c, p.offset_px));
    }
    if (!convex(*p.corners)) {
        return fail(ErrorCode::kUsage,
                    "The four corners must go around a convex quadrilateral: top left, top right, "
                    "bottom right, bottom left.");
    }
    const Mat3 plate_from_square = square_to_quad(*p.corners);
    // Plate pixels per unit of the square along its two edges, at its top left corner.
    const Vec2 origin = project(plate_from_square, {0, 0});
    constexpr float kStep = 1e-3f;
    const float along_u = glm::length(project(plate_from_square, {kStep, 0}) - origin) / kStep;
    const float along_v = glm::length(project(plate_from_square, {0, kStep}) - origin) / kStep;
    const Mat3 texels_from_square = affine(along_u / p.scale, 0, 0, along_v / p.scale, {0, 0});
    // Rotation and offset act inside the plane, so that the perspective stays the artist's.
    const Mat3 turned = glm::inverse(affine(c, -s, s, c, p.offset_px / p.scale));
    return turned * texels_from_square * glm::inverse(plate_from_square);
}

TextureCoords texture_coords(const LatticeField& ref_from_cur, const Mat3& plane_from_plate,
                             const Recti& area) {
    TextureCoords coords{ref_from_cur.dense(area), {area.x0, area.y0}};
    parallel_rows(area.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            float* d = coords.uv.row(y);
            const float py = static_cast<float>(area.y0 + y) + 0.5f;
            for (int x = 0; x < area.width(); ++x, d += 2) {
                const float px = static_cast<float>(area.x0 + x) + 0.5f;
                const Vec2 u = project(plane_from_plate, {px + d[0], py + d[1]});
                d[0] = u.x;
                d[1] = u.y;
            }
        }
    });
    return coords;
}

}  // namespace weft

#include "engine/temporal/placement.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "engine/core/parallel.h"
#include "engine/core/quad.h"

namespace weft {
namespace {

// Columns, as GLM keeps them: the map (u, v) → (a u + c v + tx, b u + d v + ty).
Mat3 affine(float a, float b, float c, float d, Vec2 t) {
    return {a, b, 0, c, d, 0, t.x, t.y, 1};
}

}  // namespace

Expected<TextureMapping> texture_mapping(const PlanePlacement& p) {
    if (!(p.scale > 0) || !std::isfinite(p.scale)) {
        return fail(ErrorCode::kUsage, "The scale must be above 0.");
    }
    // Counter-clockwise on a screen whose y points down.
    // Long double: see docs/decisions/0002-determinism.md.
    const long double angle = glm::radians(p.rotate_deg);
    const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
    const Vec2 offset = p.aspect.unsqueezed(p.offset_px);
    if (!p.corners) {
        return TextureMapping(glm::inverse(affine(p.scale * c, -p.scale * s, p.scale * s,
                                                  p.scale * c, offset)),
                              p.aspect)
            .with_warp(p.warp);
    }
    if (!is_convex<float>(*p.corners)) {
        return fail(ErrorCode::kUsage,
                    "The four corners must go around a convex quadrilateral: top left, top right, "
                    "bottom right, bottom left.");
    }
    std::array<Vec2, 4> corners = *p.corners;
    for (Vec2& corner : corners)
        corner = p.aspect.unsqueezed(corner);
    const Mat3 plate_from_square = square_to_quad<float>(corners);
    // Unsqueezed pixels per unit of the square along its two edges, at its top left corner.
    const Vec2 origin = project(plate_from_square, {0, 0});
    constexpr float kStep = 1e-3f;
    const float along_u = glm::length(project(plate_from_square, {kStep, 0}) - origin) / kStep;
    const float along_v = glm::length(project(plate_from_square, {0, kStep}) - origin) / kStep;
    const Vec2 square_texels = p.picture_texels
                                   ? Vec2(p.picture_texels->width, p.picture_texels->height)
                                   : Vec2(along_u, along_v);
    const Mat3 texels_from_square =
        affine(square_texels.x / p.scale, 0, 0, square_texels.y / p.scale, {0, 0});
    // Rotation and offset act inside the plane, so that the perspective stays the artist's.
    const Mat3 turned = glm::inverse(affine(c, -s, s, c, offset / p.scale));
    return TextureMapping(turned * texels_from_square * glm::inverse(plate_from_square), p.aspect)
        .with_warp(p.warp);
}

TextureCoords texture_coords(const LatticeField& ref_from_cur, const TextureMapping& mapping,
                             const Recti& area) {
    TextureCoords coords{ref_from_cur.dense(area), {area.x0, area.y0}};
    parallel_rows(area.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            float* d = coords.uv.row(y);
            const float py = static_cast<float>(area.y0 + y) + 0.5f;
            for (int x = 0; x < area.width(); ++x, d += 2) {
                const float px = static_cast<float>(area.x0 + x) + 0.5f;
                const Vec2 u = mapping.texel({px + d[0], py + d[1]});
                d[0] = u.x;
                d[1] = u.y;
            }
        }
    });
    return coords;
}

}  // namespace weft

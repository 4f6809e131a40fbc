#include "app/preview/surface_pattern.h"

#include <algorithm>
#include <cmath>

#include "app/preview/coords_jacobian.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

struct Cell {
    float size;  // texels
    float u, v;  // of its middle, in texels from the place
};
Cell cell_at(const float* uv, float size) {
    return {size, uv[0] - (std::floor(uv[0] / size) + 0.5f) * size,
            uv[1] - (std::floor(uv[1] / size) + 0.5f) * size};
}

// Draws what lies on the surface as the texture does: cells of a size that suits the plate, at the
// placement's scale. `value(uv, cell, jacobian)`: 0–1.
template <class Value>
void draw_cells(const TextureCoords& coords, float scale, OverlayPicture& out, Value&& value) {
    out.unit = "laid like the texture";
    constexpr int kAcross = 24;  // the plate
    const float size = static_cast<float>(out.value.width()) / kAcross / std::max(scale, 1e-3f);
    parallel_rows(out.value.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y)
            for (int x = 0; x < out.value.width(); ++x)
                if (out.where.at(x, y) != 0) {
                    const float* uv = coords.uv.pixel(x, y);
                    out.value.at(x, y) =
                        code(value(uv, cell_at(uv, size), jacobian(coords.uv, x, y)));
                }
    });
}

}  // namespace

void draw_checker(const TextureCoords& coords, float scale, OverlayPicture& out) {
    draw_cells(coords, scale, out, [](const float* uv, const Cell& cell, const Jacobian& j) {
        const auto parity = static_cast<long>(std::floor(uv[0] / cell.size)) +
                            static_cast<long>(std::floor(uv[1] / cell.size));
        const auto to_edge = [&](float at, float texels_per_px) {
            return (0.5f * cell.size - std::abs(at)) / std::max(texels_per_px, 1e-4f);
        };
        const float in =
            std::min({to_edge(cell.u, j.along_u()), to_edge(cell.v, j.along_v()), 0.5f});
        return parity % 2 == 0 ? 0.5f + in : 0.5f - in;
    });
}

void draw_circles(const TextureCoords& coords, float scale, OverlayPicture& out) {
    draw_cells(coords, scale, out, [](const float*, const Cell& cell, const Jacobian& j) {
        const float r = std::max(std::hypot(cell.u, cell.v), 1e-3f);
        // Texels of radius for a pixel of the plate.
        const float steep =
            std::hypot(cell.u * j.xx + cell.v * j.yx, cell.u * j.xy + cell.v * j.yy) / r;
        constexpr float kRadius = 0.42f, kHalfWidth_px = 1.0f;
        const float off = std::abs(r - kRadius * cell.size) / std::max(steep, 1e-4f);
        return kHalfWidth_px + 0.5f - off;
    });
}

}  // namespace weft

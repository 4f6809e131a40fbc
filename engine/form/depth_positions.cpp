#include "engine/form/depth_positions.h"

#include <cmath>
#include <limits>

#include "engine/core/parallel.h"

namespace weft {

ImageF3 positions_from_depth(const ImageF1& depth, DepthKind kind, const ViewCamera& camera,
                             PixelAspect aspect) {
    constexpr float kNowhere = 1e10f;
    ImageF3 out(depth.size(), std::numeric_limits<float>::quiet_NaN());
    parallel_rows(out.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.width(); ++x) {
                const float d = depth.row(y)[x];
                if (!(d > 0 && d < kNowhere)) continue;
                const Vec2 centre(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
                const glm::dvec3 ray = camera.ray(aspect.unsqueezed(centre));
                const double length =
                    kind == DepthKind::kZ
                        ? 1.0
                        : std::sqrt(ray.x * ray.x + ray.y * ray.y + ray.z * ray.z);
                for (int c = 0; c < 3; ++c)
                    out.pixel(x, y)[c] = static_cast<float>(ray[c] * (d / length));
            }
        }
    });
    return out;
}

}  // namespace weft

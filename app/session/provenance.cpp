#include "app/session/provenance.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

int wrapped(float v, int n) {
    const int k = static_cast<int>(std::floor(v)) % n;
    return k < 0 ? k + n : k;
}

}  // namespace

Provenance::Answer Provenance::at(Vec2 p) const {
    Answer out;
    out.on_reference = p + ref_from_cur.at(p);
    out.texel = project(plane_from_plate, out.on_reference);
    out.sample = texture;
    if (plane && std::isfinite(out.texel.x) && std::isfinite(out.texel.y)) {
        const int u = wrapped(out.texel.x, plane->source.width());
        const int v = wrapped(out.texel.y, plane->source.height());
        const std::int32_t* from = plane->source.pixel(u, v);
        out.in_sample = Vec2i(from[0], from[1]);
        constexpr int kSeam = 48;
        if (const int cost = plane->energy.at(u, v); cost > 0) out.seam = std::max(0, cost - kSeam);
        if (!plane->which.empty())
            out.sample = plane->samples[std::min<std::size_t>(plane->which.at(u, v),
                                                              plane->samples.size() - 1)];
    }
    if (shading && !shading->value.empty()) {
        const int x =
            std::clamp(static_cast<int>(p.x) / shading->downscale, 0, shading->value.width() - 1);
        const int y =
            std::clamp(static_cast<int>(p.y) / shading->downscale, 0, shading->value.height() - 1);
        out.light = shading->value.at(x, y) / std::max(reference_shading, 1e-6f);
    }
    return out;
}

}  // namespace weft

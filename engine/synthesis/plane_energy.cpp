#include "engine/synthesis/plane_energy.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/parallel.h"

namespace weft {
namespace {

// ‖A−B‖ at one pixel.
double distance(const std::uint8_t* a, const std::uint8_t* b) {
    int sum = 0;
    for (int c = 0; c < 3; ++c)
        sum += (a[c] - b[c]) * (a[c] - b[c]);
    return std::sqrt(static_cast<double>(sum));
}

}  // namespace

PlaneEnergy texel_energy(const SampleAtlas& atlas, ImageView<const std::int32_t, 2> source,
                         Vec2i at, bool wrap) {
    const int w = source.width(), h = source.height();
    const std::int32_t* s = source.pixel(at.x, at.y);
    const Vec2i p{s[0], s[1]};
    PlaneEnergy sum;
    const auto pair = [&](int x, int y, Vec2i step) {
        const std::int32_t* other = source.pixel(x, y);
        const Vec2i q{other[0], other[1]};
        if (q == p + step) return;
        const ViewU8x3 pixels = atlas.pixels();
        sum.energy += distance(pixels.pixel(p.x, p.y), atlas.continued(q - step, q)) +
                      distance(atlas.continued(p + step, p), pixels.pixel(q.x, q.y));
        ++sum.length_px;
    };
    if (at.x + 1 < w || (wrap && w > 1)) pair((at.x + 1) % w, at.y, {1, 0});
    if (at.y + 1 < h || (wrap && h > 1)) pair(at.x, (at.y + 1) % h, {0, 1});
    return sum;
}

PlaneEnergy recount_energy(const SampleAtlas& atlas, ImageView<const std::int32_t, 2> source,
                           bool wrap) {
    std::vector<PlaneEnergy> rows(static_cast<std::size_t>(source.height()));
    parallel_rows(source.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            PlaneEnergy& row = rows[static_cast<std::size_t>(y)];
            for (int x = 0; x < source.width(); ++x) {
                const PlaneEnergy part = texel_energy(atlas, source, {x, y}, wrap);
                row.energy += part.energy;
                row.length_px += part.length_px;
            }
        }
    });
    PlaneEnergy total;
    for (const PlaneEnergy& row : rows) {
        total.energy += row.energy;
        total.length_px += row.length_px;
    }
    return total;
}

}  // namespace weft

#include "engine/synthesis/feather.h"

#include <array>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/core/wrap.h"

namespace weft {
namespace {

// 1 within `radius` (in both axes) of a texel whose right or lower neighbour comes from elsewhere.
Image<std::uint8_t, 1> near_seams(ImageView<const std::int32_t, 2> source, int radius, bool wrap) {
    const int w = source.width(), h = source.height();
    Image<std::uint8_t, 1> rows(w, h, 0), out(w, h, 0);
    const auto differs = [&](int x, int y, int dx, int dy) {
        if (!wrap && (x + dx >= w || y + dy >= h)) return false;
        const std::int32_t* p = source.pixel(x, y);
        const std::int32_t* q = source.pixel((x + dx) % w, (y + dy) % h);
        return q[0] != p[0] + dx || q[1] != p[1] + dy;
    };
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            if (!differs(x, y, 1, 0) && !differs(x, y, 0, 1)) continue;
            for (int d = -radius; d <= radius; ++d) {
                if (wrap || (x + d >= 0 && x + d < w)) rows.at(wrapped(x + d, w), y) = 1;
            }
        }
    }
    for (int y = 0; y < h; ++y) {
        for (int d = -radius; d <= radius; ++d) {
            if (!wrap && (y + d < 0 || y + d >= h)) continue;
            const std::uint8_t* from = rows.row(y);
            std::uint8_t* to = out.row(wrapped(y + d, h));
            for (int x = 0; x < w; ++x)
                to[x] |= from[x];
        }
    }
    return out;
}

}  // namespace

ImageU8x3 feather_seams(const SampleAtlas& atlas, ImageView<const std::int32_t, 2> source,
                        int radius_px, bool wrap) {
    const int w = source.width(), h = source.height();
    const Image<std::uint8_t, 1> blended = near_seams(source, radius_px + 1, wrap);
    const ViewU8x3 sample = atlas.pixels();
    ImageU8x3 out(w, h);
    const auto blend = [&](int x, int y) {
        std::array<int, 3> sum{};
        int total = 0;
        for (int dy = -radius_px; dy <= radius_px; ++dy) {
            for (int dx = -radius_px; dx <= radius_px; ++dx) {
                const int qx = x + dx, qy = y + dy;
                if (!wrap && (qx < 0 || qy < 0 || qx >= w || qy >= h)) continue;
                const std::int32_t* s = source.pixel(wrapped(qx, w), wrapped(qy, h));
                const Vec2i continued{s[0] - dx, s[1] - dy};
                if (!atlas.page_of({s[0], s[1]}).rect.contains(continued.x, continued.y)) continue;
                const int weight = (radius_px + 1 - std::abs(dx)) * (radius_px + 1 - std::abs(dy));
                const std::uint8_t* rgb = sample.pixel(continued.x, continued.y);
                for (std::size_t c = 0; c < 3; ++c)
                    sum[c] += weight * rgb[c];
                total += weight;
            }
        }
        for (std::size_t c = 0; c < 3; ++c) {
            out.pixel(x, y)[c] = static_cast<std::uint8_t>((sum[c] + total / 2) / total);
        }
    };
    parallel_rows(h, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < w; ++x) {
                if (blended.at(x, y)) {
                    blend(x, y);
                    continue;
                }
                const std::int32_t* s = source.pixel(x, y);
                const std::uint8_t* rgb = sample.pixel(s[0], s[1]);
                for (int c = 0; c < 3; ++c)
                    out.pixel(x, y)[c] = rgb[c];
            }
        }
    });
    return out;
}

}  // namespace weft

#include "engine/metrics/region.h"

#include <algorithm>
#include <cmath>

#include "engine/core/luma.h"
#include "engine/core/parallel.h"

namespace weft {

ImageF1 luma_8bit(ViewF3 encoded) {
    ImageF1 out(encoded.size());
    parallel_rows(encoded.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const float* rgb = encoded.row(y);
            float* o = out.row(y);
            for (int x = 0; x < encoded.width(); ++x, rgb += 3)
                o[x] = 255.0f * luma_601(rgb);
        }
    });
    return out;
}

Matte eroded_inside(ViewU8x1 matte, int radius_px) {
    const int w = matte.width();
    const int h = matte.height();
    // Distance to the last outside pixel on the left and the next on the right gives the row's
    // erosion.
    Matte rows(matte.size());
    parallel_rows(h, 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const std::uint8_t* m = matte.row(y);
            std::uint8_t* o = rows.row(y);
            int last = -radius_px - 1;
            for (int x = 0; x < w; ++x) {
                if (m[x] < kInsideCoverage) last = x;
                o[x] = x - last > radius_px ? 255 : 0;
            }
            int next = w + radius_px;
            for (int x = w - 1; x >= 0; --x) {
                if (m[x] < kInsideCoverage) next = x;
                if (next - x <= radius_px) o[x] = 0;
            }
        }
    });
    if (radius_px == 0) return rows;
    Matte out(matte.size());
    parallel_rows(h, 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            std::uint8_t* o = out.row(y);
            std::copy_n(rows.row(y), w, o);
            for (int v = std::max(0, y - radius_px); v <= std::min(h - 1, y + radius_px); ++v) {
                const std::uint8_t* r = rows.row(v);
                for (int x = 0; x < w; ++x)
                    o[x] = std::min(o[x], r[x]);
            }
        }
    });
    return out;
}

Matte grown_cover(ViewU8x1 matte, int radius_px) {
    // Pixels without any coverage near by are the eroded inverse.
    const auto inverted = [](ViewU8x1 of) {
        Matte out(of.size());
        for (int y = 0; y < of.height(); ++y)
            for (int x = 0; x < of.width(); ++x)
                out.row(y)[x] = static_cast<std::uint8_t>(255 - of.row(y)[x]);
        return out;
    };
    return inverted(eroded_inside(inverted(matte), radius_px));
}

Matte both_inside(ViewU8x1 a, ViewU8x1 b) {
    Matte out(a.size());
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x)
            out.row(y)[x] = a.row(y)[x] == 255 && b.row(y)[x] == 255 ? 255 : 0;
    }
    return out;
}

Matte inside_and_finite(ViewU8x1 mask, ViewF1 luma) {
    Matte out(mask.size());
    for (int y = 0; y < mask.height(); ++y) {
        for (int x = 0; x < mask.width(); ++x) {
            const bool in = mask.row(y)[x] >= kInsideCoverage && std::isfinite(luma.row(y)[x]);
            out.row(y)[x] = in ? 255 : 0;
        }
    }
    return out;
}

std::int64_t count_set(ViewU8x1 mask) {
    std::int64_t n = 0;
    for (int y = 0; y < mask.height(); ++y) {
        for (int x = 0; x < mask.width(); ++x)
            n += mask.row(y)[x] != 0;
    }
    return n;
}

}  // namespace weft

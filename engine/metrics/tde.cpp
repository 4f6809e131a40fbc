#include "engine/metrics/tde.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/metrics/kernels.h"
#include "engine/metrics/motion_chain.h"
#include "engine/metrics/region.h"

namespace weft {
namespace {

float lookup(ViewF1 image, float px, float py) {
    const float x = px - 0.5f;
    const float y = py - 0.5f;
    const float fx = std::floor(x);
    const float fy = std::floor(y);
    float wx[4];
    float wy[4];
    kernel_weights(Kernel::kCatmullRom, x - fx, wx);
    kernel_weights(Kernel::kCatmullRom, y - fy, wy);
    const int ix = static_cast<int>(fx) - 1;
    const int iy = static_cast<int>(fy) - 1;
    float total = 0;
    for (int j = 0; j < 4; ++j) {
        const float* row = image.row(std::clamp(iy + j, 0, image.height() - 1));
        float line = 0;
        for (int i = 0; i < 4; ++i)
            line += wx[i] * row[std::clamp(ix + i, 0, image.width() - 1)];
        total += wy[j] * line;
    }
    return total;
}

bool on_picture(Size s, float x, float y) {
    return x >= 0 && y >= 0 && x < static_cast<float>(s.width) && y < static_cast<float>(s.height);
}

}  // namespace

Matte visible_in_both(const FlowField& f, ViewU8x1 source_matte, ViewU8x1 target_matte,
                      int erode_px) {
    Matte out = landing_is_single(f, eroded_inside(source_matte, erode_px));
    const Matte target = eroded_inside(target_matte, erode_px);
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            if (out.at(x, y) == 0) continue;
            const float tx = static_cast<float>(x) + 0.5f + f.d.at(x, y, 0);
            const float ty = static_cast<float>(y) + 0.5f + f.d.at(x, y, 1);
            if (!on_picture(out.size(), tx, ty) ||
                target.at(static_cast<int>(tx), static_cast<int>(ty)) == 0)
                out.at(x, y) = 0;
        }
    }
    return out;
}

TemporalError measure_tde(ViewF1 source_luma, ViewF1 target_luma, const FlowField& f,
                          ViewU8x1 visible) {
    std::vector<RowSum> rows(static_cast<std::size_t>(source_luma.height()));
    parallel_rows(source_luma.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < source_luma.width(); ++x) {
                if (visible.row(y)[x] == 0) continue;
                const float there =
                    lookup(target_luma, static_cast<float>(x) + 0.5f + f.d.at(x, y, 0),
                           static_cast<float>(y) + 0.5f + f.d.at(x, y, 1));
                const double e = std::abs(static_cast<double>(source_luma.row(y)[x]) -
                                          static_cast<double>(there));
                if (std::isfinite(e)) rows[static_cast<std::size_t>(y)].add(e);
            }
        }
    });
    RowSum all;
    for (const RowSum& r : rows)
        all.add(r);
    return {all.mean(), all.count};
}

TemporalError warped_tde(ViewF1 earlier_luma, const FlowField& earlier_from_later,
                         const FlowField& later_from_earlier, ViewU8x1 visible) {
    ImageF1 later = moved(earlier_luma, earlier_from_later);
    for (int y = 0; y < later.height(); ++y)
        for (int x = 0; x < later.width(); ++x)
            if (earlier_from_later.valid.at(x, y) == 0)
                later.at(x, y) = std::numeric_limits<float>::quiet_NaN();
    return measure_tde(earlier_luma, later, later_from_earlier, visible);
}

ImageF1 moved(ViewF1 image, const FlowField& f) {
    ImageF1 out(f.size());
    parallel_rows(out.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.width(); ++x) {
                const float tx = static_cast<float>(x) + 0.5f + f.d.at(x, y, 0);
                const float ty = static_cast<float>(y) + 0.5f + f.d.at(x, y, 1);
                if (f.valid.at(x, y) != 0 && on_picture(image.size(), tx, ty))
                    out.at(x, y) = lookup(image, tx, ty);
            }
        }
    });
    return out;
}

}  // namespace weft

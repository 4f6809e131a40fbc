#include "engine/metrics/sharpness.h"

#include <algorithm>
#include <cmath>

#include "engine/metrics/local_mean.h"
#include "engine/metrics/region.h"

namespace weft {
namespace {

constexpr int kErodePx = 4;
// A texture of one colour has only rounding errors.
constexpr double kLeastDetail = 1e-4;

}  // namespace

Detail measure_detail(ViewF1 luma, ViewU8x1 region) {
    const Matte inside = inside_and_finite(region, luma);
    const Matte core = eroded_inside(inside, kErodePx);
    const ImageF1 n = divided_by_local_mean(luma, inside);
    RowSum laplacian;
    RowSum value;
    for (int y = 1; y + 1 < n.height(); ++y) {
        RowSum l;
        RowSum v;
        const float* up = n.row(y - 1);
        const float* here = n.row(y);
        const float* down = n.row(y + 1);
        for (int x = 1; x + 1 < n.width(); ++x) {
            if (core.row(y)[x] == 0) continue;
            l.add(std::abs(
                static_cast<double>(here[x - 1] + here[x + 1] + up[x] + down[x] - 4.0f * here[x])));
            v.add(static_cast<double>(here[x]));
        }
        laplacian.add(l);
        value.add(v);
    }
    const double mean = value.mean();
    Detail d;
    d.pixels = value.count;
    if (d.pixels == 0) return d;
    d.mean_laplacian = laplacian.mean();
    d.rms_contrast = std::sqrt(
        std::max(0.0, value.sum_squared / static_cast<double>(value.count) - mean * mean));
    return d;
}

SharpnessKept sharpness_kept(ViewF1 result, ViewF1 ideal, ViewU8x1 region) {
    const Matte both = inside_and_finite(inside_and_finite(region, result), ideal);
    const Detail r = measure_detail(result, both);
    const Detail i = measure_detail(ideal, both);
    if (i.pixels < kLeastDetailPixels || i.mean_laplacian < kLeastDetail ||
        i.rms_contrast < kLeastDetail)
        return {};
    return {r.mean_laplacian / i.mean_laplacian, r.rms_contrast / i.rms_contrast, i.pixels};
}

}  // namespace weft

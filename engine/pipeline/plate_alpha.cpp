#include "engine/pipeline/plate_alpha.h"

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/pipeline/plate_views.h"

namespace weft {
namespace {

constexpr int kBandRows = 32;

std::uint8_t share_of(std::uint8_t matte, float alpha, bool associated) {
    if (matte == 0 || !std::isfinite(alpha) || alpha >= 1) return matte;
    if (!(alpha > 0)) return associated ? std::uint8_t{0} : matte;
    // A matte and an alpha that are one may differ by the rounding of the matte's 8 bits.
    const float whole = 255.0f * alpha;
    if (static_cast<float>(matte) + 0.51f >= whole) return 255;
    return static_cast<std::uint8_t>(std::lround(255.0f * static_cast<float>(matte) / whole));
}

}  // namespace

Expected<ImageF3> working_plate(const ShotSource& source, const ShotPlan& plan, int frame,
                                const ImageF3& plate) {
    WEFT_TRY(alpha, source.alpha(frame));
    if (!alpha.associated()) return transformed(plate, *plan.working_from_plate);
    ImageF3 out = plate;
    unassociate(out, *alpha.coverage);
    plan.working_from_plate->apply(out);
    return out;
}

ImageF3 plate_in(const ImageF3& plate, const PlateAlpha& alpha, const ColorTransform& transform) {
    if (transform.identity()) return plate;
    ImageF3 out = plate;
    if (alpha.associated()) unassociate(out, *alpha.coverage);
    out = transformed(out, transform);
    if (!alpha.associated()) return out;
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const float a = alpha.coverage->row(y)[x];
            if (!(a > 0) || !std::isfinite(a)) continue;
            for (int c = 0; c < 3; ++c)
                out.pixel(x, y)[c] *= a;
        }
    }
    return out;
}

void take_share_of_element(Matte& matte, const PlateAlpha& alpha) {
    if (!alpha.coverage || matte.empty()) return;
    parallel_rows(matte.height(), kBandRows, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            std::transform(
                matte.row(y), matte.row(y) + matte.width(), alpha.coverage->row(y), matte.row(y),
                [&](std::uint8_t m, float a) { return share_of(m, a, alpha.associated()); });
        }
    });
}

void put_alpha_back(ImageView<float, 3> picture, ViewU8x1 touched, const PlateAlpha& alpha) {
    if (!alpha.associated()) return;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            const float a = alpha.coverage->row(y)[x];
            if (touched.row(y)[x] == 0 || !std::isfinite(a) || a == 1) continue;
            for (int c = 0; c < 3; ++c)
                picture.pixel(x, y)[c] *= a;
        }
    }
}

}  // namespace weft

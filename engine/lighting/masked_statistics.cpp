#include "engine/lighting/masked_statistics.h"

#include <cmath>
#include <vector>

#include "engine/core/median.h"
#include "engine/core/parallel.h"
#include "engine/lighting/masked_filters.h"

namespace weft {
namespace {

constexpr float kKnownWeight = 1e-3f;  // of a window: below this there is no estimate

}  // namespace

MaskedBlur blurred(const ImageF1& weighted_plane, const ImageF1& weight, float sigma) {
    MaskedBlur out{weighted_plane, Matte(weight.size())};
    ImageF1 total = weight;
    gaussian_blur(out.value, sigma);
    gaussian_blur(total, sigma);
    parallel_rows(weight.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < weight.width(); ++x) {
                const bool known = total.row(y)[x] > kKnownWeight;
                out.known.row(y)[x] = known ? 255 : 0;
                out.value.row(y)[x] = known ? out.value.row(y)[x] / total.row(y)[x] : 0.0f;
            }
        }
    });
    fill_unknown(out.value, out.known);
    return out;
}

float deviation_between(const ImageF1& a, const ImageF1& b, const ImageF1& weight) {
    std::vector<float> differences;
    for (int y = 0; y < a.height(); y += 2) {
        for (int x = 0; x < a.width(); x += 2) {
            if (weight.row(y)[x] > 0) differences.push_back(std::abs(a.row(y)[x] - b.row(y)[x]));
        }
    }
    return kDeviationOfMedian * median_of(differences, 0.0f);
}

}  // namespace weft

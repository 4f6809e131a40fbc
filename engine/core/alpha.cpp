#include "engine/core/alpha.h"

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr int kBandRows = 32;

// Most pixels are opaque; they keep every bit.
bool changes(float alpha) {
    return std::isfinite(alpha) && alpha != 1;
}

void associate_row(float* rgb, const float* alpha, int width) {
    for (int x = 0; x < width; ++x, rgb += 3) {
        if (!changes(alpha[x])) continue;
        const float a = std::max(alpha[x], 0.0f);
        for (int c = 0; c < 3; ++c)
            rgb[c] = a > 0 ? rgb[c] * a : 0.0f;
    }
}

}  // namespace

bool has_coverage(ViewF1 alpha) {
    for (int y = 0; y < alpha.height(); ++y) {
        const float* row = alpha.row(y);
        if (std::any_of(row, row + alpha.width(), [](float a) { return a > 0; })) return true;
    }
    return false;
}

void associate(ImageView<float, 3> rgb, ViewF1 alpha) {
    if (!has_coverage(alpha)) return;
    parallel_rows(rgb.height(), kBandRows, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y)
            associate_row(rgb.row(y), alpha.row(y), rgb.width());
    });
}

void unassociate_row(float* rgb, const float* alpha, int width) {
    for (int x = 0; x < width; ++x, rgb += 3) {
        if (!changes(alpha[x]) || !(alpha[x] > 0)) continue;
        for (int c = 0; c < 3; ++c)
            rgb[c] /= alpha[x];
    }
}

void unassociate(ImageView<float, 3> rgb, ViewF1 alpha) {
    if (!has_coverage(alpha)) return;
    parallel_rows(rgb.height(), kBandRows, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y)
            unassociate_row(rgb.row(y), alpha.row(y), rgb.width());
    });
}

}  // namespace weft

#include "engine/pipeline/opaque_picture.h"

#include <algorithm>

#include "engine/lighting/masked_filters.h"

namespace weft {

void make_opaque(ImageF3& rgb, const ImageF1& alpha, AlphaKind kind) {
    constexpr float kThere = 0.5f;
    if (alpha.empty() || !has_coverage(alpha)) return;
    if (kind == AlphaKind::kAssociated) unassociate(rgb, alpha);
    Matte known(rgb.size());
    std::transform(alpha.data(), alpha.data() + known.size_bytes(), known.data(),
                   [](float a) { return a >= kThere ? 255 : 0; });
    for (int c = 0; c < 3; ++c) {
        ImageF1 plane(rgb.size());
        for (int y = 0; y < plane.height(); ++y)
            for (int x = 0; x < plane.width(); ++x)
                plane.at(x, y) = rgb.at(x, y, c);
        fill_unknown(plane, known);
        for (int y = 0; y < plane.height(); ++y)
            for (int x = 0; x < plane.width(); ++x)
                rgb.at(x, y, c) = plane.at(x, y);
    }
}

}  // namespace weft

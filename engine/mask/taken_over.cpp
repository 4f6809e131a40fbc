#include "engine/mask/taken_over.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/mask/signed_distance.h"

namespace weft {

Matte differing(const Matte& inside, const ImageF1& distance) {
    Matte out(inside.size());
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            out.at(x, y) = (distance.at(x, y) > 0) == (inside.at(x, y) != 0) ? 0 : 255;
    return out;
}

void take_over(const Matte& inside, float limit_px, ImageF1& distance, Matte& matte) {
    constexpr float kBeside_px = 2;
    const ImageF1 found = smooth_distance(signed_distance(inside, limit_px), 1);
    for (int y = 0; y < matte.height(); ++y) {
        for (int x = 0; x < matte.width(); ++x) {
            const bool as_before = (distance.at(x, y) > 0) == (inside.at(x, y) != 0);
            if (as_before && std::abs(distance.at(x, y) - found.at(x, y)) < kBeside_px) continue;
            distance.at(x, y) = found.at(x, y);
            matte.at(x, y) = static_cast<std::uint8_t>(
                std::lround(255 * std::clamp(0.5f + found.at(x, y), 0.0f, 1.0f)));
        }
    }
}

Matte inside_without(ViewF1 distance, const Matte& pieces) {
    Matte out(distance.size());
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x)
            out.at(x, y) = distance.row(y)[x] > 0 && pieces.at(x, y) == 0 ? 255 : 0;
    }
    return out;
}

}  // namespace weft

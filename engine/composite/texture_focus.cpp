#include "engine/composite/texture_focus.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/composite/focus.h"
#include "engine/core/blur_inside.h"

namespace weft {
namespace {

constexpr float kMostCorrection = 1.2f;

// By how much a blur has to be changed for the edges to come out as they would if they were ideal.
float correction(const ImageF3& texture, const Matte& all, float own_px, float blur_px) {
    ImageF3 tried = texture;
    blur_inside(tried, all, blur_px);
    const float got_px = edge_blur_px(tried, all);
    if (!(got_px > 0)) return 1;
    const float variance = 2 * blur_px * blur_px + own_px * own_px - got_px * got_px;
    return std::clamp(std::sqrt(std::max(0.0f, variance)) / blur_px, 1 / kMostCorrection,
                      kMostCorrection);
}

}  // namespace

float TextureFocus::own_blur_px(float times) const {
    // Blur of the texture itself grows with it; that of the pixels' grid does not.
    constexpr float kGrid = kSharpestEdge_px * kSharpestEdge_px;
    const float inherent = std::max(0.0f, own_px * own_px - kGrid);
    return std::min(std::sqrt(kGrid + times * times * inherent), kSoftestEdge_px);
}

float TextureFocus::needed_px(float times, float plate_px) const {
    const float blur = blur_between(own_blur_px(times), plate_px);
    if (!(blur > 0)) return 0;
    std::size_t k = 0;
    while (k + 2 < kTried_px.size() && blur > kTried_px[k + 1])
        ++k;
    const float t =
        std::clamp((blur - kTried_px[k]) / (kTried_px[k + 1] - kTried_px[k]), 0.0f, 1.0f);
    return blur * (again[k] + t * (again[k + 1] - again[k]));
}

TextureFocus texture_focus(const ImageF3& texture) {
    TextureFocus out;
    const Matte all(texture.size(), 255);
    out.own_px = edge_blur_px(texture, all);
    if (!(out.own_px > 0)) return out;
    for (std::size_t k = 0; k < out.again.size(); ++k)
        out.again[k] = correction(texture, all, out.own_px, TextureFocus::kTried_px[k]);
    return out;
}

}  // namespace weft

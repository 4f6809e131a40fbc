#include "engine/lighting/exact_light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft {
namespace {

constexpr float kBlackAlbedo = 0.004f;  // an 8-bit albedo is not reliable below
constexpr float kBrightestLight = 64.0f;

std::array<float, 3> light_at(const float* plate, const float* albedo) {
    std::array<float, 3> light{};
    float sum = 0;
    int known = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        light[c] = albedo[c] > kBlackAlbedo ? plate[c] / albedo[c] : -1.0f;
        if (light[c] >= 0) sum += light[c], ++known;
    }
    for (float& l : light)
        if (!(l >= 0)) l = known > 0 ? sum / static_cast<float>(known) : 1.0f;
    return light;
}

}  // namespace

void apply_exact_light(ImageView<float, 3> texture, ViewF3 plate, ViewF3 albedo, ViewF3 lighting,
                       ViewU8x1 matte, float strength) {
    for (int y = 0; y < texture.height(); ++y) {
        for (int x = 0; x < texture.width(); ++x) {
            if (matte.row(y)[x] == 0) continue;
            std::array<float, 3> light{};
            if (albedo.empty())
                std::copy_n(lighting.pixel(x, y), 3, light.begin());
            else
                light = light_at(plate.pixel(x, y), albedo.pixel(x, y));
            for (std::size_t c = 0; c < 3; ++c) {
                if (!std::isfinite(light[c])) continue;
                texture.pixel(x, y)[c] *=
                    1 + strength * (std::clamp(light[c], 0.0f, kBrightestLight) - 1);
            }
        }
    }
}

}  // namespace weft

#include "engine/pipeline/uv_coords.h"

#include <array>
#include <cmath>

namespace weft {
namespace {

// Grows by one pixel: continues the pixel behind it and the one that lies `base` pixels behind that
// in a straight line, in eight directions.
void continue_outwards(ImageF2& coords, Matte& known, int base) {
    static constexpr std::array<std::array<int, 2>, 8> kWays{
        {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};
    const ImageF2 before = coords;
    const Matte was = known;
    const auto has = [&](int x, int y) {
        return x >= 0 && y >= 0 && x < was.width() && y < was.height() && was.at(x, y) != 0;
    };
    for (int y = 0; y < was.height(); ++y) {
        for (int x = 0; x < was.width(); ++x) {
            if (was.at(x, y) != 0) continue;
            float sum[2] = {0, 0};
            int count = 0;
            for (const auto& [dx, dy] : kWays) {
                const int u = x + (1 + base) * dx, v = y + (1 + base) * dy;
                if (!has(x + dx, y + dy) || !has(u, v)) continue;
                const float* near = before.pixel(x + dx, y + dy);
                const float* far = before.pixel(u, v);
                for (int c = 0; c < 2; ++c)
                    sum[c] += base == 1 ? 2 * near[c] - far[c]
                                        : near[c] + (near[c] - far[c]) / static_cast<float>(base);
                ++count;
            }
            if (count == 0) continue;
            for (int c = 0; c < 2; ++c)
                coords.pixel(x, y)[c] = sum[c] / static_cast<float>(count);
            known.at(x, y) = 255;
        }
    }
}

// True if a pixel that shows more than `matte` has no coordinates yet.
bool lacks_any(const Matte& known, ViewU8x1 matte, ViewU8x1 shown) {
    for (int y = 0; y < known.height(); ++y)
        for (int x = 0; x < known.width(); ++x)
            if (known.at(x, y) == 0 && shown.row(y)[x] > matte.row(y)[x]) return true;
    return false;
}

}  // namespace

TextureCoords coords_from_uv(const ImageF2& uv, const Recti& box, ViewU8x1 matte, ViewU8x1 shown,
                             Size plane, float scale) {
    // Far out a longer base keeps the pass' rounding from growing.
    constexpr int kReach = 3, kFarReach = 256, kLongBase = 6;
    TextureCoords out;
    out.uv = ImageF2(box.size());
    out.origin = {box.x0, box.y0};
    Matte known(box.size());
    for (int y = 0; y < box.height(); ++y) {
        for (int x = 0; x < box.width(); ++x) {
            const float* from = uv.pixel(box.x0 + x, box.y0 + y);
            const bool finite = std::isfinite(from[0]) && std::isfinite(from[1]);
            out.uv.pixel(x, y)[0] =
                finite ? from[0] * static_cast<float>(plane.width) / scale : 0.0f;
            out.uv.pixel(x, y)[1] =
                finite ? (1 - from[1]) * static_cast<float>(plane.height) / scale : 0.0f;
            known.at(x, y) = matte.row(y)[x] == 255 && finite ? 255 : 0;
        }
    }
    for (int k = 0; k < kReach; ++k)
        continue_outwards(out.uv, known, 1);
    for (int k = kReach; k < kFarReach && lacks_any(known, matte, shown); ++k)
        continue_outwards(out.uv, known, kLongBase);
    return out;
}

}  // namespace weft

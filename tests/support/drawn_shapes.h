#pragma once
// Shapes of several levels as a matte, to compare it with another one.

#include <algorithm>

#include "engine/mask/outline_lives.h"
#include "engine/mask/shape_matte.h"

namespace weft::test {

/// 255 where the centre of a pixel is inside. (polygon_matte() draws the pixels that an outline
/// touches, so it is half a pixel larger at half coverage.)
inline Matte centres_inside(const std::vector<Vec2>& polygon, Size size) {
    Matte out(size);
    for (int y = 0; y < size.height; ++y) {
        const float row = static_cast<float>(y) + 0.5f;
        std::vector<float> crossings;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Vec2 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
            if ((a.y > row) != (b.y > row))
                crossings.push_back(a.x + (row - a.y) / (b.y - a.y) * (b.x - a.x));
        }
        std::sort(crossings.begin(), crossings.end());
        for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
            for (int x = 0; x < size.width; ++x)
                if (const float at = static_cast<float>(x) + 0.5f;
                    at >= crossings[k] && at < crossings[k + 1])
                    out.at(x, y) = 255;
    }
    return out;
}

/// What the shapes of a frame cover: holes taken off, what is inside of them put back.
inline Matte drawn_shapes(const std::vector<MatteShape>& shapes, int frame, Size size) {
    Matte out(size);
    for (const MatteShape& shape : shapes) {  // by level
        const auto key = shape.keys.find(frame);
        if (key == shape.keys.end()) continue;
        const Matte drawn = centres_inside(outline_of(key->second), size);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                if (drawn.at(x, y) > 0) out.at(x, y) = shape.level % 2 == 1 ? 0 : 255;
    }
    return out;
}

/// Intersection over union of two mattes at half coverage.
inline double overlap_at_half(const Matte& a, const Matte& b) {
    std::int64_t both = 0, any = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            const bool in_a = a.at(x, y) > 127, in_b = b.at(x, y) > 127;
            both += in_a && in_b ? 1 : 0;
            any += in_a || in_b ? 1 : 0;
        }
    return any > 0 ? static_cast<double>(both) / static_cast<double>(any) : 1.0;
}

}  // namespace weft::test

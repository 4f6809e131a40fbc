#include "engine/mask/key_places.h"

#include "engine/core/parallel.h"
#include "engine/mask/signed_distance.h"

namespace weft {

ImageF2 own_places(Size size) {
    ImageF2 places(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            places.pixel(x, y)[0] = static_cast<float>(x);
            places.pixel(x, y)[1] = static_cast<float>(y);
        }
    }
    return places;
}

ImageF2 follow_places(ViewF2 key_from_prev, ViewF2 prev_from_cur, const Recti& area) {
    ImageF2 places(area.size());
    parallel_rows(area.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < area.width(); ++x) {
                const float* d = prev_from_cur.pixel(x, y);
                const Vec2 k =
                    sample_bilinear(key_from_prev, static_cast<float>(area.x0 + x) + d[0],
                                    static_cast<float>(area.y0 + y) + d[1]);
                places.pixel(x, y)[0] = k.x;
                places.pixel(x, y)[1] = k.y;
            }
        }
    });
    return places;
}

}  // namespace weft

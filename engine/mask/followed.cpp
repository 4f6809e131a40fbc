#include "engine/mask/followed.h"

#include <utility>

#include "engine/core/geometry.h"
#include "engine/core/parallel.h"
#include "engine/mask/confirmed_part.h"
#include "engine/mask/nearest_pixel.h"

namespace weft {

void Followed::advance(const FollowedStep& step) {
    const Recti frame = rect_of(known_.size());
    Matte moved(known_.size());
    parallel_rows(moved.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < moved.width(); ++x) {
                const bool inside = step.phi.row(y)[x] > 0;
                // What was found again elsewhere has no motion of the surface's.
                if (inside ? !step.area.contains(x, y) : step.parting.at(x, y) != 0) continue;
                const float* d = inside
                                     ? step.surface_motion.pixel(x - step.area.x0, y - step.area.y0)
                                     : step.flow.d.pixel(x, y);
                const Vec2i from =
                    nearest_pixel({static_cast<float>(x) + d[0], static_cast<float>(y) + d[1]});
                if (!frame.contains(from.x, from.y)) continue;
                if (inside && step.prev_phi.row(from.y)[from.x] <= 0) continue;
                moved.at(x, y) = known_.at(from.x, from.y);
            }
        }
    });
    known_ = std::move(moved);
}

void Followed::know(ViewU8x1 area) {
    for (int y = 0; y < area.height(); ++y) {
        for (int x = 0; x < area.width(); ++x)
            if (is_confirmed(area.row(y)[x])) known_.at(x, y) = kKnown;
    }
}

}  // namespace weft

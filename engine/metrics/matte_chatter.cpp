#include "engine/metrics/matte_chatter.h"

#include <algorithm>
#include <cmath>

#include "engine/metrics/motion_chain.h"
#include "engine/metrics/region.h"

namespace weft {
namespace {

constexpr double kLeastEdgePx = 16;

// Coverage 0–1 between the centres of four pixels.
double coverage_at(ViewU8x1 matte, double px, double py) {
    const double x = std::clamp(px - 0.5, 0.0, matte.width() - 1.0);
    const double y = std::clamp(py - 0.5, 0.0, matte.height() - 1.0);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, matte.width() - 1), y1 = std::min(y0 + 1, matte.height() - 1);
    const double fx = x - x0, fy = y - y0;
    const double above = matte.row(y0)[x0] * (1 - fx) + matte.row(y0)[x1] * fx;
    const double below = matte.row(y1)[x0] * (1 - fx) + matte.row(y1)[x1] * fx;
    return (above * (1 - fy) + below * fy) / 255.0;
}

}  // namespace

std::optional<double> matte_chatter_px(const FlowField& motion, ViewU8x1 from, ViewU8x1 to) {
    // Where two motions land at one place, one of them is hidden there.
    const Matte seen = landing_is_single(motion, grown_cover(from, kChatterReachPx));
    RowSum change, edge;
    for (int y = 1; y + 1 < from.height(); ++y) {
        for (int x = 1; x + 1 < from.width(); ++x) {
            if (seen.at(x, y) == 0) continue;
            const double tx = x + 0.5 + static_cast<double>(motion.d.at(x, y, 0));
            const double ty = y + 0.5 + static_cast<double>(motion.d.at(x, y, 1));
            if (tx < 1 || ty < 1 || tx > from.width() - 1 || ty > from.height() - 1) continue;
            change.add(std::abs(coverage_at(to, tx, ty) - from.row(y)[x] / 255.0));
            edge.add(std::hypot(from.row(y)[x + 1] - from.row(y)[x - 1],
                                from.row(y + 1)[x] - from.row(y - 1)[x]) /
                     510.0);
        }
    }
    if (edge.sum < kLeastEdgePx) return std::nullopt;
    return change.sum / edge.sum;
}

}  // namespace weft

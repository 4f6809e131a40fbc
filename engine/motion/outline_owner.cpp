#include "engine/motion/outline_owner.h"

#include <cmath>

#include "engine/motion/edge_direction.h"

namespace weft {
namespace {

// Whether motion can be seen around (x, y): flat fills move with the nearest line.
bool has_structure(ViewU8x1 luma, int x, int y) {
    constexpr int kReach = 3, kCount = (2 * kReach + 1) * (2 * kReach + 1);
    constexpr int kLeast = 2;  // levels of deviation; flat fills have none
    int sum = 0, squares = 0;
    for (int dy = -kReach; dy <= kReach; ++dy) {
        for (int dx = -kReach; dx <= kReach; ++dx) {
            const int v = luma.at(x + dx, y + dy);
            sum += v, squares += v * v;
        }
    }
    return kCount * squares - sum * sum > kLeast * kLeast * kCount * kCount;
}

}  // namespace

double occluded_share(ViewU8x1 luma, ViewU8x1 extent, const LatticeField& outline,
                      const LatticeField& inside, const FlowField& raw, Vec2 unseen) {
    // Raw motion is a mixture so near to an edge.
    constexpr float kAway_px = 7;
    constexpr int kFrameMargin_px = 12;  // from the frame's border
    // Slower than that the two sides cannot be told apart.
    constexpr float kApart_px = 0.5f, kWith = 0.3f, kFacing = 0.7f;
    int told = 0, with_outside = 0;
    for (int y = kFrameMargin_px; y < extent.height() - kFrameMargin_px; ++y) {
        for (int x = kFrameMargin_px; x < extent.width() - kFrameMargin_px; ++x) {
            if ((x + y) % 3 != 0 || extent.at(x, y) < 128) continue;
            if (extent.at(x - 1, y) >= 128 && extent.at(x + 1, y) >= 128 &&
                extent.at(x, y - 1) >= 128 && extent.at(x, y + 1) >= 128)
                continue;
            const Vec2 n = outwards(extent, x, y);
            if (std::abs(glm::dot(n, unseen)) > kFacing) continue;
            const Vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            const Vec2 out = p + kAway_px * n;
            const int ox = static_cast<int>(out.x), oy = static_cast<int>(out.y);
            if (extent.at(ox, oy) >= 128 || raw.valid.at(ox, oy) == 0 ||
                !has_structure(luma, ox, oy))
                continue;
            const float* d = raw.d.pixel(ox, oy);
            // Of an edge's motion only what goes across it can be seen.
            const float edge = glm::dot(n, outline.at(p)), within = glm::dot(n, inside.at(p));
            const float without = glm::dot(n, Vec2(d[0], d[1]));
            const float apart = std::abs(within - without);
            if (apart < kApart_px) continue;
            ++told;
            with_outside += std::abs(edge - without) < kWith * apart;
        }
    }
    constexpr int kEnough = 20;
    return told < kEnough ? 0 : static_cast<double>(with_outside) / told;
}

}  // namespace weft

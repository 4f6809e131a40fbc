#include "engine/mask/motion_support.h"

#include <algorithm>
#include <cmath>

#include "engine/core/smooth_step.h"
#include "engine/mask/patch_difference.h"

namespace weft {
namespace {

// How many times less the picture must change along the other motion.
constexpr float kSameMotion = 1.2f, kOtherMotion = 2;
constexpr float kNoise = 3;  // 8-bit levels

bool has_patch(Vec2i p, Size size) {
    return p.x >= kPatchRadius && p.y >= kPatchRadius && p.x < size.width - kPatchRadius &&
           p.y < size.height - kPatchRadius;
}

// Mean difference, 8-bit levels, of a pixel's surroundings and the most similar ones of the frame
// before around where `motion` leads.
float difference_along(const FramePair& pair, Vec2i at, Vec2 motion) {
    const Vec2i to = at + Vec2i(static_cast<int>(std::lround(motion.x)),
                                static_cast<int>(std::lround(motion.y)));
    const Vec2i here = at - Vec2i(pair.area.x0, pair.area.y0);
    if (!has_patch(here, pair.area.size())) return 0;
    int least = 255 * kPatchValues;
    for (int v = to.y - 1; v <= to.y + 1; ++v) {
        for (int u = to.x - 1; u <= to.x + 1; ++u) {
            if (!has_patch({u, v}, pair.prev_frame.size())) continue;
            const int difference =
                patch_difference(pair.frame.pixel(here.x, here.y), pair.frame.stride(),
                                 pair.prev_frame.pixel(u, v), pair.prev_frame.stride(), least);
            least = std::min(least, difference);
        }
    }
    return static_cast<float>(least) / kPatchValues;
}

}  // namespace

float speaks_against(const FramePair& pair, Vec2i at, Vec2 motion, Vec2 other) {
    const float ratio = (difference_along(pair, at, motion) + kNoise) /
                        (difference_along(pair, at, other) + kNoise);
    return smooth_step(ratio, kSameMotion, kOtherMotion);
}

}  // namespace weft

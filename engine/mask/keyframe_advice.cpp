#include "engine/mask/keyframe_advice.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace weft {
namespace {

// A painted frame improves its neighbours; after so many frames half of their shortfall is back.
constexpr float kLiftFrames = 10;

struct Stretch {
    std::size_t first = 0, last = 0;  // inclusive
    float shortfall = 0;
};

// The unpainted stretch with the largest total shortfall.
Stretch worst_stretch(const std::vector<FrameConfidence>& frames, const std::vector<int>& painted,
                      float wanted) {
    Stretch worst, present;
    bool inside = false;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (std::binary_search(painted.begin(), painted.end(), frames[i].frame)) {
            inside = false;
            continue;
        }
        if (!inside) present = {i, i, 0};
        inside = true;
        present.last = i;
        present.shortfall += std::max(0.0f, wanted - frames[i].confidence);
        if (present.shortfall > worst.shortfall) worst = present;
    }
    return worst;
}

// The frame that halves a stretch's shortfall.
std::size_t halving_frame(const std::vector<FrameConfidence>& frames, const Stretch& stretch,
                          float wanted) {
    float sum = 0;
    for (std::size_t i = stretch.first; i < stretch.last; ++i) {
        sum += std::max(0.0f, wanted - frames[i].confidence);
        if (sum >= stretch.shortfall / 2) return i;
    }
    return stretch.last;
}

}  // namespace

std::vector<int> suggest_keyframes(std::vector<FrameConfidence> frames,
                                   const std::vector<int>& painted, float wanted, int most) {
    std::vector<int> keys = painted, suggested;
    std::sort(keys.begin(), keys.end());
    while (static_cast<int>(suggested.size()) < most) {
        const Stretch stretch = worst_stretch(frames, keys, wanted);
        if (stretch.shortfall <= 0) break;
        const int frame = frames[halving_frame(frames, stretch, wanted)].frame;
        suggested.push_back(frame);
        keys.insert(std::upper_bound(keys.begin(), keys.end(), frame), frame);
        for (FrameConfidence& f : frames) {
            const auto away = static_cast<float>(std::abs(f.frame - frame));
            f.confidence = std::max(f.confidence, std::exp2(-away / kLiftFrames));
        }
    }
    return suggested;
}

}  // namespace weft

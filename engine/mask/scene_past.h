#pragma once
// Internal to resting_scene: what the last frames showed. What a passing thing uncovers is only
// known to be the surface after some frames; it was so on those, too.

#include <cstddef>
#include <deque>
#include <glm/mat3x3.hpp>
#include <vector>

#include "engine/core/image.h"
#include "engine/mask/scene_motion.h"

namespace weft {

/// A frame of a scene at rest, by blocks.
struct SceneView {
    glm::dmat3 key_from_frame{1};  ///< px
    ImageF3 colors;                ///< Codes in the light of the keyframe.
    Matte inside;                  ///< 255: the surface.
    Matte sure;                    ///< 255: it is known to be the surface.
    Matte late = {};               ///< 255: it was found later to have been inside.
};

/// Not thread-safe.
class ScenePast {
  public:
    static constexpr std::size_t kFrames = 8;

    /// Goes on to the next frame. Of the frames before it, the latest first, 255 by blocks that
    /// were outside though they and all frames since showed what is sure now, in colours that
    /// differ by less than `same_levels`; strips along the boundary are left out. Empty where that
    /// is not more than it was. Deterministic.
    [[nodiscard]] std::vector<Matte> advance(SceneView now, const SceneScale& scale,
                                             float same_levels);
    /// Nothing is known of the frames before.
    void forget() { views_.clear(); }

  private:
    std::deque<SceneView> views_;  // latest first
};

}  // namespace weft

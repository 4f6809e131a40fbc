#pragma once
// Internal to resting_scene: how the camera moves, and what moves by itself.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <optional>

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// A frame as it is reduced: blocks of `step` × `step` pixels.
struct SceneScale {
    explicit SceneScale(Size frame);

    int step;       ///< So that a frame has about 427 blocks in a row.
    Size size;      ///< In blocks.
    float unit_px;  ///< A pixel of a frame 854 wide.

    /// The middle of a block, px of the frame.
    [[nodiscard]] Vec2 middle(int x, int y) const;
    /// The pixel there.
    [[nodiscard]] Vec2i pixel(int x, int y) const;
};

/// Whether something moves as a scene does; unknown where too little of it is seen or followed.
enum class SceneMotion : std::uint8_t { kUnknown, kRests, kMoves };

/// The step of a scene from one frame to the next.
struct SceneStep {
    glm::dmat3 prev_from_cur{1};  ///< A homography, px.
    Matte moving;                 ///< By blocks: 255 where something moves otherwise.
    SceneMotion surface = SceneMotion::kUnknown;  ///< Of most of it.
    SceneMotion around = SceneMotion::kUnknown;   ///< Of much of it, or of what is in front.
};

/// `prev_from_cur`: as measured; `phi`: the surface's signed distance, px. Both of the frame's
/// size. Deterministic.
[[nodiscard]] SceneStep scene_step(const FlowField& prev_from_cur, ViewF1 phi,
                                   const SceneScale& scale);

/// Where the frame's pixels lie on a picture that is expected there, right to about a block: a
/// homography, px, from the lumas of both where `known` is not 0, all by blocks. Empty if they do
/// not agree. Deterministic.
[[nodiscard]] std::optional<glm::dmat3> expected_from_cur(const ImageF1& expected,
                                                          const ImageF1& luma, const Matte& known,
                                                          const SceneScale& scale);

}  // namespace weft

#pragma once
// A scene in which nothing but the camera and what passes in front moves.

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "engine/core/fields.h"
#include "engine/core/geometry.h"
#include "engine/core/image.h"
#include "engine/mask/scene_motion.h"
#include "engine/mask/scene_past.h"
#include "engine/mask/scene_places.h"
#include "engine/mask/surface_palette.h"

namespace weft {

/// A wall, a floor or a table stays where it is in the scene, and so does what is around it. As
/// long as one homography from the keyframe explains the motion of both, what each place shows is
/// remembered, and how often that was inside of the matte. So what a passing thing uncovers is the
/// surface's if it was so before, or if it has the surface's colours, is joined to it, and was not
/// seen on the keyframe; and what leaves the surface, moves over other places and has none of its
/// colours is a passing thing itself, though the matte was painted over it. What bends, or moves
/// against its surroundings, is no such scene: it is left as it is. Not thread-safe.
class RestingScene {
  public:
    /// `key_frame`: display codes; `key_phi`: signed distance of its matte, px.
    RestingScene(ViewU8x3 key_frame, ViewF1 key_phi);

    /// Goes on by a frame. `prev_from_cur`: motion as measured, `phi`: the signed distance that was
    /// found, px, both of the frame's size. Of that size: 255 inside, 0 outside, as the scene has
    /// it. Empty if nothing is to be corrected. Parallel over rows; deterministic.
    [[nodiscard]] Matte corrected(ViewU8x3 frame, ViewF1 phi, const FlowField& prev_from_cur,
                                  const SurfacePalette& palette);
    /// Remembers what the frame shows, with its final matte. Of the frames before it, the latest
    /// first, 255 by blocks that are found to have been inside, too (ScenePast).
    [[nodiscard]] std::vector<Matte> remember(ViewF1 phi, const SurfacePalette& palette);
    /// The frame's pixels that are not 0 in `where` are known to be inside, or outside, as `inside`
    /// says. What is found of earlier frames does not follow from that.
    void correct(ViewU8x1 where, ViewU8x1 inside);

  private:
    static constexpr float kNear_px = 60;  // of 854×480: what is around the surface
    static constexpr float kMatches = 3;   // noise

    // What is known of what a block of the frame shows.
    struct Seen {
        float frames = 0;     // in which it was seen; 0: it is not known
        float inside = 0.5;   // how often that was the surface's
        bool is_new = false;  // the keyframe does not show it
    };
    enum class Verdict : std::uint8_t {
        kAsFound,
        kLeaves,     // is inside, and none of the surface
        kReturns,    // is outside, and was the surface before
        kUncovered,  // is outside, and may have been behind something
        kOther       // is outside, and always was
    };

    [[nodiscard]] bool is_there(int x, int y) const;
    [[nodiscard]] bool passes(int x, int y) const { return moving_.at(x, y) != 0; }
    [[nodiscard]] std::size_t index_of(int x, int y) const;
    [[nodiscard]] float depth(ViewF1 phi, int x, int y) const;
    [[nodiscard]] Vec2i place_of(int x, int y) const;
    [[nodiscard]] Recti shown_places() const;
    [[nodiscard]] Vec3 unlit(int x, int y) const;
    [[nodiscard]] ImageF1 expected_luma() const;
    [[nodiscard]] float nearest(Vec2i place, Vec3 color, float least, Seen& seen) const;
    [[nodiscard]] float miss(int x, int y, Seen& seen) const;
    [[nodiscard]] float odds(const SurfacePalette& palette, int x, int y) const;
    [[nodiscard]] Verdict judged(int x, int y, float inside_px,
                                 const SurfacePalette& palette) const;
    [[nodiscard]] bool is_outside(Vec2i place) const;
    [[nodiscard]] Matte to_change(ViewF1 phi, const SurfacePalette& palette) const;
    [[nodiscard]] double leaving_blocks(const Matte& change, ViewF1 phi) const;
    void see_places(ViewF1 phi);
    [[nodiscard]] std::vector<Matte> found_late(ViewF1 phi, const SurfacePalette& palette);
    void move(ViewU8x3 frame, const FlowField& prev_from_cur, ViewF1 phi);
    [[nodiscard]] std::optional<Vec2> rests_as_on_key(ViewU8x3 frame, ViewF1 phi) const;
    void keep_resting(Vec2 shift, const ImageF3& before, Matte moving);
    void stay_on_place(ViewF1 phi, const ImageF1& luma);
    void compare();
    void measure_noise(ViewF1 phi);
    [[nodiscard]] Matte explain(ViewF1 phi, const SurfacePalette& palette);

    SceneScale scale_;  // the pictures below are by blocks
    double key_area_px_;
    ScenePlaces places_;
    ScenePast past_ = {};
    Matte key_luma_;          // of all pixels of the keyframe
    ImageF3 now_;             // the frame
    ImageF1 gain_;            // how much brighter it is than the keyframe
    Matte moving_;            // what moves otherwise than the scene
    Matte returning_;         // may be the surface's, but in too small a piece to be changed
    ImageF1 misses_;          // difference from what is known, in noise
    std::vector<Seen> seen_;  // row by row
    glm::dmat3 key_from_cur_{1};
    float noise_levels_ = 3;
    float against_ = 0;  // frames that spoke against such a scene, less half of those for it
    bool rests_ = true, fits_ = true;  // at all; on this frame
    bool is_key_ = true;
};

}  // namespace weft

#pragma once
// Finds parts of a surface again that were hidden, or out of the frame, and came back.

#include <glm/mat3x3.hpp>
#include <utility>

#include "engine/core/geometry.h"
#include "engine/core/image.h"
#include "engine/mask/pattern_return.h"

namespace weft {

/// Where a walk's surface is expected, as the plane that its keyframe shows, and whether the frame
/// shows it there. Not thread-safe.
class SurfaceReturn {
  public:
    /// `key_frame`: display codes; `key_phi`: signed distance of its matte, px.
    SurfaceReturn(ViewU8x3 key_frame, ViewF1 key_phi);

    /// The step to a frame: `prev_from_cur`, the background's motion, px, H×W×2 and finite. What is
    /// hidden moves with the background.
    void move(ViewF2 prev_from_cur);
    /// What the frame shows of the surface: `phi` its signed distance and `key_from_cur` the place
    /// of its pixels on the keyframe, px, both of the pixels of `area`. Enough of it says where the
    /// whole lies.
    void follow(ViewF1 phi, ViewF2 key_from_cur, const Recti& area);

    /// The pixels that are the surface's though `phi` (of the whole frame) has them outside: inside
    /// of where it is expected by some pixels, and of the keyframe's pattern there, but for light
    /// (the correlation of the lumas in a window) and a shift of a few pixels, which is kept. 255
    /// or 0; empty if there are none. What is too plain to have a pattern comes back with what it
    /// surrounds it only. Nothing, if the surface bent while it was seen. Deterministic.
    [[nodiscard]] Matte returned(ViewU8x3 frame, ViewF1 phi);
    /// Where pixel (x, y) lies on the keyframe, px.
    [[nodiscard]] Vec2 key_place(int x, int y) const;

  private:
    // How deep inside of its matte a pixel's place on the keyframe lies, px; below 0 it is outside.
    [[nodiscard]] float expected(int x, int y) const;
    [[nodiscard]] std::pair<double, Recti> missing(ViewF1 phi) const;
    void look_around(ViewU8x3 frame);
    void shift_by(Vec2i px);
    void register_near(ViewU8x3 frame, const Recti& box);
    [[nodiscard]] Matte expanded(const Matte& found, const Recti& box, Size frame) const;
    [[nodiscard]] PatternPair pair_in(const Recti& box, ViewU8x3 frame, ViewF1 phi) const;

    float unit_px_;     // a pixel of a frame 854 wide
    int step_;          // patterns are compared in pictures reduced by this, 427 wide
    ImageF1 key_luma_;  // reduced
    ImageF1 key_phi_;
    double key_area_px_ = 0;
    glm::dmat3 key_from_cur_{1}, key_from_seen_{1};  // and as it was when much was seen
    bool is_piece_ = true;  // most of it moved by that plane when it was seen
    bool waits_ = false;    // a frame, after a search in vain
};

}  // namespace weft

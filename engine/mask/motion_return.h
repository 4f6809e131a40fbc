#pragma once
// Finds a surface again that bends, or moves otherwise than its background, after it was lost.

#include <vector>

#include "engine/core/fields.h"
#include "engine/core/geometry.h"
#include "engine/core/image.h"
#include "engine/mask/motion_evidence.h"

namespace weft {

/// What departs from the background's motion in the surface's colours and is about as large as it
/// was. SurfaceReturn knows a stiff surface by its pattern; this needs none. Not thread-safe.
class MotionReturn {
  public:
    /// `key_phi`: signed distance of the painted matte, px.
    explicit MotionReturn(ViewF1 key_phi);

    /// Whether so little of the surface is seen that it says nothing of the whole.
    [[nodiscard]] bool lost(ViewF1 phi) const;

    /// The whole surface, 255 or 0: once it has been lost and something has been there on three
    /// frames in a row, and on the frames after that, until it is about as large as it was. Else
    /// empty. Deterministic.
    [[nodiscard]] Matte returned(const MotionReturnInput& in);
    /// Where pixel (x, y) of what returned lies on the keyframe, px, if it only moved and shrank.
    [[nodiscard]] Vec2 key_place(int x, int y) const;

  private:
    /// The middle of an area, and the root of its size, px.
    struct Extent {
        Vec2 middle{0, 0};
        float side = 0;
        void add(int x, int y);  // a pixel, of a sum that finish() ends
        void finish();
    };
    struct Piece {
        double area_px = 0;
        double motion = 0;  // sum of the log odds of its motion
        double weight = 0;  // by which it is chosen
    };
    [[nodiscard]] int best_of(const std::vector<Piece>& pieces) const;
    [[nodiscard]] bool stays(const Matte& found, const FlowField& flow);

    Extent key_, found_;
    double usual_px_;  // the surface's area while it was seen
    Matte candidate_;  // of the last frame
    int frames_ = 0;   // for which it has been there
    int taken_ = 0;    // frames for which it is still taken as a whole
};

}  // namespace weft

#pragma once
// What a drawing shows of a flat surface: its outline and its lines.

#include <memory>

#include "engine/core/image.h"
#include "engine/motion/outline_curve.h"
#include "engine/motion/photometric_register.h"

namespace weft {

/// One frame of a region; all H×W, 8 bit.
struct OutlineView {
    ViewU8x1 luma;
    ViewU8x1 extent;   ///< The region's full matte, whose outline is the shape's.
    ViewU8x1 visible;  ///< The same without holdouts.
};

/// What is compared of one frame, by the width of the band about its outline. Each picture is made
/// when it is first asked for and kept, since a frame is registered against the one before it, the
/// one after it and the reference frame. Const access is thread-safe.
class OutlineShape {
  public:
    explicit OutlineShape(const OutlineView& view);
    ~OutlineShape();
    OutlineShape(OutlineShape&&) noexcept;
    OutlineShape& operator=(OutlineShape&&) noexcept;

    [[nodiscard]] bool empty() const;
    [[nodiscard]] Size frame_size() const;
    /// The extent's centre of area, px of the frame; (0, 0) if it is empty.
    [[nodiscard]] Vec2 middle() const;
    [[nodiscard]] float area_px() const;
    [[nodiscard]] const OutlineCurve& curve() const;
    /// The signed distance within `band_px` of the outline, and inside of it the luma, smoothed by
    /// `sigma_px`, less its surroundings.
    [[nodiscard]] const RegistrationPicture& picture(float band_px, float sigma_px) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace weft

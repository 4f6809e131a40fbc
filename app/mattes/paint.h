#pragma once
// Painting on mattes: pure functions for the editor's tools.

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/core/image.h"
#include "engine/core/pixel_aspect.h"

namespace weft {

struct Brush {
    float radius_px = 24;   ///< Unsqueezed.
    float hardness = 0.8f;  ///< 1: hard edge; 0: soft from the centre.
    float opacity = 1;      ///< Opacity of the whole stroke, where it crosses itself too.
    bool subtract = false;
    bool pressure_size = true, pressure_opacity = false;  ///< What pen pressure controls.
    PixelAspect aspect = {};  ///< Of what it paints on; it is round on the picture unsqueezed.
    bool operator==(const Brush&) const = default;
};

/// One stroke on a matte. Crossing itself adds nothing, so the opacity is that of the whole stroke.
class Stroke {
  public:
    /// `before` must not be null. It is neither copied nor changed, so a stroke begins at once on
    /// any size.
    Stroke(std::shared_ptr<const Matte> before, const Brush& brush);
    /// Paints from the last point to `to`; the first call makes a dot. `pressure` in (0, 1] scales
    /// the radius, the opacity or both, as the brush says. Returns the changed part of `matte`.
    Recti move_to(Vec2 to, float pressure, Matte& matte);
    [[nodiscard]] const Recti& touched() const { return touched_; }
    /// 255 where the stroke painted, else 0; of the matte's size.
    [[nodiscard]] Matte covered() const;

  private:
    struct Release {
        void operator()(std::uint8_t* memory) const { std::free(memory); }
    };
    std::shared_ptr<const Matte> before_;
    // Coverage of each pixel. The system zero-fills pages on first access, so only pages under the
    // stroke use memory.
    std::unique_ptr<std::uint8_t[], Release> coverage_;
    Brush brush_;
    std::optional<Vec2> last_;
    float last_radius_ = 0, last_pressure_ = 1;
    Recti touched_;
};

/// Adds or removes the inside of a closed polygon (even-odd rule), anti-aliased.
[[nodiscard]] Matte fill_polygon(const Matte& before, const std::vector<Vec2>& points,
                                 bool subtract);
/// Adds or removes the connected area whose colour is within `tolerance` (0–255 per channel) of the
/// colour at `seed`.
[[nodiscard]] Matte flood_select(const Matte& before, ViewU8x3 picture, Vec2i seed, int tolerance,
                                 bool subtract);
/// 255 where two mattes of one size differ and a few pixels around, so that the new edge lies
/// inside; else 0.
[[nodiscard]] Matte changed_area(const Matte& before, const Matte& after);
/// Grows (px > 0) or shrinks (px < 0) the matte.
[[nodiscard]] Matte grow_matte(const Matte& before, float px);
/// Softens the edge over about `px` on each side.
[[nodiscard]] Matte feather_matte(const Matte& before, float px);

}  // namespace weft

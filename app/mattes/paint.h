#pragma once
// Painting on mattes: pure functions on pixels, used by the editor's tools.

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

struct Brush {
    float radius_px = 24;
    float hardness = 0.8f;  ///< 1: a hard edge; 0: falls off from the centre.
    float opacity = 1;      ///< Of the whole stroke, however often it crosses itself.
    bool subtract = false;
    bool pressure_size = true, pressure_opacity = false;  ///< What a pen's pressure changes.
    bool operator==(const Brush&) const = default;
};

/// One stroke on a matte. The pixels under a stroke never change twice: crossing itself adds
/// nothing, so opacity is that of the stroke.
class Stroke {
  public:
    /// `before` is never null. Neither copies nor touches it: a stroke begins at once on any size.
    Stroke(std::shared_ptr<const Matte> before, const Brush& brush);
    /// Paints from the last point to `to` (the first call makes a dot); `pressure` in (0, 1] scales
    /// the radius, the opacity or both, as the brush says. Returns what changed of `matte`.
    Recti move_to(Vec2 to, float pressure, Matte& matte);
    [[nodiscard]] const Recti& touched() const { return touched_; }

  private:
    struct Release {
        void operator()(std::uint8_t* memory) const { std::free(memory); }
    };
    std::shared_ptr<const Matte> before_;
    // Of every pixel of the matte: the system gives zeroes where the stroke goes, and there only.
    std::unique_ptr<std::uint8_t[], Release> coverage_;
    Brush brush_;
    std::optional<Vec2> last_;
    float last_radius_ = 0, last_pressure_ = 1;
    Recti touched_;
};

/// Adds or removes the inside of a closed polygon (even-odd), its edge anti-aliased.
[[nodiscard]] Matte fill_polygon(const Matte& before, const std::vector<Vec2>& points,
                                 bool subtract);
/// Adds or removes the connected area whose colour is within `tolerance` (0–255 a channel) of the
/// seed's.
[[nodiscard]] Matte flood_select(const Matte& before, ViewU8x3 picture, Vec2i seed, int tolerance,
                                 bool subtract);
/// Grows (px > 0) or shrinks (px < 0) by a distance.
[[nodiscard]] Matte grow_matte(const Matte& before, float px);
/// Softens the edge over about `px` to either side.
[[nodiscard]] Matte feather_matte(const Matte& before, float px);
/// What the scribbles suggest: `keep` and `drop` mark surely inside and outside (above 127); found
/// on a crop around them at up to 512 px. The rest of `before` stays.
[[nodiscard]] Matte segment_scribbles(const Matte& before, ViewU8x3 picture, const Matte& keep,
                                      const Matte& drop);

}  // namespace weft

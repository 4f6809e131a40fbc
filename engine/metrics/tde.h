#pragma once
// Temporal Difference Error (method.md, 7): how much a result changes along the motion of the
// surface.

#include <cstdint>

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// The pixels of a field that are measured: inside `source_matte` eroded by `erode_px`, with valid
/// motion that lands alone (landing_is_single()) inside `target_matte`, eroded likewise. 255 or 0.
[[nodiscard]] Matte visible_in_both(const FlowField& target_from_source, ViewU8x1 source_matte,
                                    ViewU8x1 target_matte, int erode_px = 2);

struct TemporalError {
    double tde = 0;           ///< Mean |Y_source(p) − Y_target(p + d(p))|, 8-bit units.
    std::int64_t pixels = 0;  ///< Pixels visible in both; with 0 `tde` is undefined.
};

/// The error along `target_from_source`, measured in the source frame's pixels: for a forward field
/// the source is the earlier frame, for a backward one the later. The lookup at p + d(p) is a
/// Catmull-Rom cubic on clamped borders, not clipped. Both lumas in 8-bit units. `visible` from
/// visible_in_both(). Pixels whose luma is not finite on either side are left out.
[[nodiscard]] TemporalError measure_tde(ViewF1 source_luma, ViewF1 target_luma,
                                        const FlowField& target_from_source, ViewU8x1 visible);

/// What measure_tde() would give if the later picture were the earlier one warped along
/// `earlier_from_later`: the part of the error that comes from the disagreement of the given motion
/// with that field, at this contrast, and not from a change. Otherwise as there; 0 pixels where the
/// field is not valid.
[[nodiscard]] TemporalError warped_tde(ViewF1 earlier_luma, const FlowField& earlier_from_later,
                                       const FlowField& later_from_earlier, ViewU8x1 visible);

/// Warps a picture: out(p) = image(p + d(p)) with the same lookup, 0 where the field is not valid.
[[nodiscard]] ImageF1 moved(ViewF1 image, const FlowField& image_from_out);

}  // namespace weft

#pragma once
// Parts of a matte that an artist has confirmed on a frame that is propagated otherwise.

#include <cstdint>
#include <limits>
#include <optional>

#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

/// "This edge is right": inside of `area` (above 127) the matte is as here. Both are of one size.
struct ConfirmedPart {
    Matte matte;  ///< Of the whole frame, as it was when a part of it was confirmed.
    Matte area;
};

/// Whether a code of an area says so.
[[nodiscard]] constexpr bool is_confirmed(std::uint8_t code) {
    return code > 127;
}

/// `matte` with the part's codes inside of its area; all of one size.
[[nodiscard]] Matte with_confirmed(Matte matte, const ConfirmedPart& part);

/// By pixel, for how many frames of a walk a confirmed part has been carried.
using FramesSince = Image<std::uint16_t, 1>;
inline constexpr std::uint16_t kNeverConfirmed = std::numeric_limits<std::uint16_t>::max();

/// Where a walk passes the places that were confirmed on its way. Not thread-safe.
class ConfirmedPlaces {
  public:
    /// A confirmed part's area on the walk's present frame.
    void add(ViewU8x1 area);
    /// Goes on by a frame. `prev_from_cur`: the surface's motion, extended outwards, px, over
    /// `area` of the frame; outside of that nothing is confirmed any more. Parallel over rows;
    /// deterministic.
    void move(ViewF2 prev_from_cur, const Recti& area);
    /// The surface has left the frame.
    void clear() { since_ = {}; }

    [[nodiscard]] bool any() const { return !since_.empty(); }
    /// Of the frame's size; empty if nothing has been confirmed.
    [[nodiscard]] const FramesSince& since() const { return since_; }

  private:
    FramesSince since_;
};

/// Where a frame lies between what two walks know: keyframes, and what was confirmed on the way.
struct MergePlace {
    int frame = 0;
    /// The keyframes that the walks come from; without one, that walk has a say only where parts
    /// were confirmed.
    std::optional<int> before, after;
};

/// By pixel, the share of the way from the last known frame before to the next one after that lies
/// behind `place.frame`, 0–1, blurred over some pixels where one of both is confirmed. `since` of
/// either walk may be empty, else it is H×W.
[[nodiscard]] ImageF1 merge_positions(const MergePlace& place, const FramesSince& before,
                                      const FramesSince& after, Size size);

}  // namespace weft

#pragma once
// A plate's focus over time: what single frames tell of it, and what their neighbours make of that
// (method: "Grain and focus").

#include <vector>

#include "engine/composite/focus_map.h"

namespace weft {

/// What one frame tells of the plate's blur in a region.
struct FocusReading {
    float blur_px = 0;     ///< strong_blur_px(); 0: it cannot be told.
    float error_px = 0;    ///< Deviation of that.
    float confidence = 0;  ///< blur_confidence().
    BlurSlope slope;       ///< Relative to the plate's origin.
    bool has_lens = false;
    FocusModel lens;  ///< With a depth pass, of the whole plate.
};

struct TimedReading {
    int frame = 0;
    FocusReading reading;
};

/// Focus is read on the frames whose number is a multiple of kFocusStep, and on all frames between
/// two of them that differ(). Those up to kFocusReach frames away tell the focus of a frame.
inline constexpr int kFocusStep = 4, kFocusReach = 12;

/// Whether two readings differ by more than their errors, and by something that is to be seen.
[[nodiscard]] bool differ(const FocusReading& a, const FocusReading& b);

/// The plate's blur on one frame.
struct FocusState {
    float blur_px = 0;     ///< 0: no frame tells.
    float confidence = 0;  ///< 0–1.
    BlurSlope slope;       ///< `agreement` is its share in the blur.
    struct Lens {
        float weight = 0;
        FocusModel model;
    };
    std::vector<Lens> lenses;  ///< Their weights sum to 1; empty: no depth pass, or it shows none.
    /// By the lenses. `lenses` must not be empty.
    [[nodiscard]] float lens_blur_px(float nearness) const;
};

/// The blur on a frame: a line over time through the readings around it (local regression,
/// Cleveland 1979) that counts each by its errors and its confidence, follows none that departs
/// from what the others say (Geman & McClure 1985), and reaches as far as is needed to be sure. It
/// varies smoothly with the frame. Readings more than kFocusReach away do not count.
[[nodiscard]] FocusState focus_at(int frame, const std::vector<TimedReading>& readings);

}  // namespace weft

#pragma once
// Whether two frames are equal, and where they differ (`weft diff`).

#include <array>
#include <cstdint>
#include <optional>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

/// Values in the frames' own units (1.0 = white of an integer file). Two NaN are equal whatever
/// their bits; a NaN beside a number is an infinite difference.
struct FrameDiff {
    bool equal = true;
    std::array<double, 3> max_abs{};   ///< Per channel.
    std::array<double, 3> mean_abs{};  ///< Per channel, over all pixels of the frame.
    std::int64_t pixels = 0;
    std::int64_t differing = 0;  ///< Pixels that differ in any channel.
    Recti box;                   ///< Around all of them; empty if there are none.
    std::optional<Vec2i> first;  ///< The first of them in scanline order.
    /// 10 log10(1 / mean squared difference) over all channels; empty if the frames are equal.
    std::optional<double> psnr_db;
};

/// Errors: Differs if the sizes differ (the message gives both).
[[nodiscard]] Expected<FrameDiff> diff_frames(ViewF3 a, ViewF3 b);

/// The same over the pixels where `where` is 0: outside a matte nothing may change. Errors: also
/// Unreadable if `where` has another size.
[[nodiscard]] Expected<FrameDiff> diff_outside(ViewF3 a, ViewF3 b, ViewU8x1 where);

/// The summary of many frames.
struct SequenceDiff {
    std::int64_t frames = 0;
    std::int64_t differing_frames = 0;
    double max_abs = 0;  ///< Of any channel.
    std::optional<int> first_differing_frame;
    std::optional<double> least_psnr_db;

    void add(int frame, const FrameDiff& d);
    [[nodiscard]] bool equal() const { return differing_frames == 0; }
};

}  // namespace weft

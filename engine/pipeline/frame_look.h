#pragma once
// What a plate's frame shows as a whole: enough to tell a cut, a flash and a black frame.

#include <array>

#include "engine/core/image.h"

namespace weft {

/// A frame's luma, display-encoded, 0 to 1.
struct FrameLook {
    static constexpr int kColumns = 16, kRows = 9, kBins = 32;
    std::array<float, kColumns * kRows> means{};  ///< Of each cell.
    std::array<float, kBins> shares{};            ///< Histogram.
    float spread = 0;                             ///< From the 2nd to the 98th percentile.
};

/// Samples the picture. NaN counts as black.
[[nodiscard]] FrameLook look_at(ViewF3 plate, bool display_encoded);
[[nodiscard]] FrameLook look_at(ViewU8x1 luma);

/// How two frames differ.
struct LookChange {
    float place = 0;     ///< Mean difference of the cells, relative to white.
    float share = 0;     ///< Share of the histogram that changes.
    float likeness = 0;  ///< Correlation of the cells, which exposure does not change; −1 to 1.
};
[[nodiscard]] LookChange change_between(const FrameLook& a, const FrameLook& b);

/// At a cut, both the spatial distribution and the histogram of luma change far more than within a
/// scene; a fast pan changes only one of them.
[[nodiscard]] bool may_be_cut(const LookChange& change);
/// The same, and the picture has not only become brighter or darker.
[[nodiscard]] bool is_another_scene(const FrameLook& a, const FrameLook& b);

/// True if a frame shows nothing, next to one of a spread of `usual`: black, burnt out, of one
/// colour, but for noise.
[[nodiscard]] bool shows_nothing(const FrameLook& look, float usual);

}  // namespace weft

#pragma once
// A block of two neighbouring frames, registered by a smooth motion and a smooth change of light.
// What remains is new in every frame.

#include <array>
#include <optional>

#include "engine/core/image.h"

namespace weft {

/// The pictures that blocks are cut from. All of one size.
struct BlockPair {
    ViewF3 current, previous;
    ViewU8x1 visible, previous_visible;  ///< 255: counts.
    ImageF1 luma, previous_luma;
    ImageF1 small_luma, small_previous_luma;  ///< Half the size.

    BlockPair(ViewF3 current, ViewF3 previous, ViewU8x1 visible, ViewU8x1 previous_visible);
};

struct RegisteredBlock {
    static constexpr int kSide = 30;
    static constexpr int kBorder = 1;  ///< Pixels that a block needs around it.
    ImageF3 residual;  ///< kSide²: current − previous, less motion and change of light.
    ImageF3 mean;      ///< Of both.
    ImageF3 detail;    ///< Product of both frames' detail (3×3), by channel.
    /// Autocorrelation at lags 0 to 3 that white noise of deviation 1 in one frame has after the
    /// lookup, along x and y.
    std::array<std::array<float, 4>, 2> lookup{};
};

/// `corner`: top left of the block. `start`: displacement (pixels) near which it is searched, in
/// addition to 0. Each frame is moved by half of the fractional displacement, so that the lookup
/// blurs both alike and static detail cancels. Empty if the block is not wholly visible in both
/// frames.
[[nodiscard]] std::optional<RegisteredBlock> register_block(const BlockPair& pair, Vec2i corner,
                                                            std::array<float, 2> start);

}  // namespace weft

#pragma once
// A block of two neighbouring frames, laid on top of each other as well as a smooth motion and a
// smooth change of light can: what is left is what is fresh in every frame.

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
    static constexpr int kBorder = 1;  ///< That a block needs around it.
    ImageF3 residual;  ///< kSide²: current − previous, less motion and change of light.
    ImageF3 mean;      ///< Of both.
    ImageF3 detail;    ///< What both frames' detail (3×3) has in common: its product, by channel.
    /// Autocorrelation at lags 0 to 3 that white noise of deviation 1 in one frame has after the
    /// lookup, along x and y.
    std::array<std::array<float, 4>, 2> lookup{};
};

/// `corner`: upper left of the block; `start`: where it is to be looked for, as a displacement in
/// pixels (besides where it is). Both frames are moved by half of what is not a whole pixel, so
/// that the lookup blurs them alike and still detail cancels. Nothing where the block is not wholly
/// visible in both.
[[nodiscard]] std::optional<RegisteredBlock> register_block(const BlockPair& pair, Vec2i corner,
                                                            std::array<float, 2> start);

}  // namespace weft

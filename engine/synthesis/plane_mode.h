#pragma once

namespace weft {

/// How a sample covers a plane.
enum class PlaneMode {
    kAuto,        ///< Synthesized; a periodic sample on its own lattice.
    kSynthesize,  ///< Synthesized; patches of a periodic sample keep to their neighbours only.
    kTile,        ///< The sample itself, repeated by whole periods.
    kStretch,     ///< The sample once.
    kMirror       ///< The sample repeated, every other time mirrored.
};

/// Modes that show the sample itself.
[[nodiscard]] constexpr bool shows_sample(PlaneMode mode) {
    return mode != PlaneMode::kAuto && mode != PlaneMode::kSynthesize;
}

}  // namespace weft

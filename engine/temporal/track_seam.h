#pragma once
// The seam between two tracks of a surface. Coordinates tracked from the reference
// before and from the reference after disagree, so every place of the surface changes once from the
// one track to the other.

#include <cstdint>
#include <vector>

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// The coordinates (ref_from_cur) of one frame between two references, by both tracks.
struct TrackLayers {
    LatticeField before, after;
    bool apart = false;  ///< True if they differ anywhere on the surface.
};

/// Spreads the disagreement of two tracks over the interval between their references. Where they
/// differ by less than `limit_px`, both become before + weight · (after − before), and the texture
/// slides too slowly to be seen. From twice the limit on, both stay as they are and a seam chooses
/// between them. `weight`: position in time, 0–1. `extent`: the region's full matte. Pure.
[[nodiscard]] TrackLayers spread_disagreement(const LatticeField& before, const LatticeField& after,
                                              float weight, float limit_px, ViewU8x1 extent);

/// What one frame shows of the surface, by cells of the reference frame. Both of the same size.
struct TrackEvidence {
    /// Mean distance of the two textures' colours, 8-bit levels; 0 where not visible.
    ImageF1 mismatch;
    ImageF1 pixels;  ///< How many pixels of the frame lie in the cell.
};

struct TrackCutOptions {
    float lambda = 1;        ///< λ_t: weight of a place's change (the paper, eq. 5).
    std::uint64_t seed = 1;  ///< Seed of the order in which places change.
};

/// The labels by frame and cell, 1 where the track after shows: the minimum cut over space and
/// time. Between cells a seam costs the mismatch along it. A cell's change between two frames costs
/// λ_t ‖T_label − warp(T_{t−1})‖² (the paper, eq. 5 and 6), and each cell changes once, from the
/// track before to the track after. If all changed at once the picture would flash, so each place
/// is held to a time of its own, smoothly random over the surface. Pure; deterministic.
[[nodiscard]] std::vector<Image<std::uint8_t, 1>> cut_between_tracks(
    const std::vector<TrackEvidence>& frames, const TrackCutOptions& options);

/// The labels of one interval, for lookup.
struct TrackSeam {
    int first = 0, last = 0;  ///< The references; labels are for the frames between.
    int cell_px = 4;          ///< A cell's side on the reference frame.
    Vec2i origin{0, 0};       ///< Of the cells, in pixels of the reference frame.
    std::vector<Image<std::uint8_t, 1>> after;  ///< From first + 1 to last − 1.
    [[nodiscard]] bool covers(int frame) const { return frame > first && frame < last; }
    /// The share of the track after at a place on the reference frame: 0 or 1, and between them
    /// only within about a pixel of a seam.
    [[nodiscard]] float share_after(int frame, Vec2 ref) const;
};

}  // namespace weft

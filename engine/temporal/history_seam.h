#pragma once
// Where two histories of a surface meet: the coordinates as followed from the reference before and
// from the one after do not agree, and every place of the surface changes once from the one to the
// other.

#include <cstdint>
#include <vector>

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// The coordinates (ref_from_cur) of one frame between two references, by both histories.
struct HistoryLayers {
    LatticeField before, after;
    bool apart = false;  ///< Whether they differ anywhere on the surface.
};

/// Spreads what can be spread of two histories' disagreement over the interval between their
/// references: where they differ by less than `limit_px`, both become before + weight · (after −
/// before), so the texture slides too slowly to be seen; from twice that on each stays as it is,
/// and the choice between them is left to a seam. `weight`: position in time, 0–1. `extent`: the
/// region's matte. Pure.
[[nodiscard]] HistoryLayers spread_disagreement(const LatticeField& before,
                                                const LatticeField& after, float weight,
                                                float limit_px, ViewU8x1 extent);

/// What one frame shows of the surface, by cells of the reference frame. Both of the same size.
struct HistoryEvidence {
    ImageF1 mismatch;  ///< Mean distance of the two textures' colours, 8-bit levels; 0 unseen.
    ImageF1 pixels;    ///< How many pixels of the frame lie in the cell.
};

struct HistoryCutOptions {
    float lambda = 1;        ///< λ_t: weight of a place's change (the paper, eq. 5).
    std::uint64_t seed = 1;  ///< Of the order in which places change.
};

/// The labels, for each frame and cell 1 where the history after shows: the minimum cut over space
/// and time. Between cells a seam costs the mismatch along it; a cell's change between two frames
/// costs λ_t ‖T_label − warp(T_{t−1})‖² (the paper, eq. 5 and 6), and it changes once, from the
/// history before to the one after. So that not everything changes at once, which flashes, each
/// place has its time, smoothly random over the surface, that it is held to. Pure; deterministic.
[[nodiscard]] std::vector<Image<std::uint8_t, 1>> cut_histories(
    const std::vector<HistoryEvidence>& frames, const HistoryCutOptions& options);

/// The labels of an interval, ready to be looked up.
struct HistorySeam {
    int first = 0, last = 0;  ///< The references; labels are for the frames between.
    int cell_px = 4;          ///< A cell's side on the reference frame.
    Vec2i origin{0, 0};       ///< Of the cells, in pixels of the reference frame.
    std::vector<Image<std::uint8_t, 1>> after;  ///< From first + 1 to last − 1.
    [[nodiscard]] bool covers(int frame) const { return frame > first && frame < last; }
    /// The share of the history after at a place of the surface (on the reference frame): 0 or 1
    /// but within a pixel or so of a seam.
    [[nodiscard]] float share_after(int frame, Vec2 ref) const;
};

}  // namespace weft

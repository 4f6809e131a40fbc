#pragma once
// Edge tools of a matte: what an artist changes about its edge after it was painted, propagated or
// read (method: "Edge tools").

#include "engine/core/image.h"
#include "engine/core/keyed_numbers.h"

namespace weft {

/// Settings of the edge tools, applied in this order; 0 leaves the matte as it is. Lengths in
/// pixels of the matte.
struct MatteEdge {
    int min_island_px = 0;  ///< Islands of fewer pixels are removed.
    int min_hole_px = 0;    ///< Holes of fewer pixels are filled.
    /// Smooths the outline: deviation of the Gaussian that its signed distance is filtered by.
    float smooth_px = 0;
    float choke_px = 0;  ///< Above 0 the matte grows, below 0 it shrinks.
    /// Length of a linear ramp: above 0 outwards of the edge, whose inner end stays; below 0
    /// inwards, whose outer end stays.
    float feather_px = 0;
    float blur_px = 0;  ///< Deviation of a Gaussian on the matte itself.

    [[nodiscard]] bool none() const { return *this == MatteEdge{}; }
    bool operator==(const MatteEdge&) const = default;
};

/// The same over time: keys replace the value beside them.
struct MatteEdgePlan {
    MatteEdge edge;
    KeyedNumbers choke_keys, feather_keys, blur_keys;

    /// True if no frame's matte is changed.
    [[nodiscard]] bool none() const {
        return edge.none() && choke_keys.empty() && feather_keys.empty() && blur_keys.empty();
    }
    [[nodiscard]] MatteEdge at(int frame) const;
};

/// The settings for a matte that is `factor` times smaller.
[[nodiscard]] MatteEdgePlan divided(const MatteEdgePlan& plan, int factor);

/// Applies the settings to coverage from 0 to 1. The frame's border is no edge. Only the box that
/// holds the matte and what may reach beyond it is worked on; the time is linear in its pixels.
/// Thread-safe; the same for any number of threads.
[[nodiscard]] ImageF1 with_edge(ViewF1 alpha, const MatteEdge& edge);
/// The same of 8-bit coverage, rounded once, at the end. Without settings the same bytes.
[[nodiscard]] Matte with_edge(Matte matte, const MatteEdge& edge);

}  // namespace weft

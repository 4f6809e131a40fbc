#pragma once
#include "engine/motion/lattice_field.h"

namespace weft {

/// Where the places of a surface lie when it is laid flat, over a rectangle of the reference
/// frame's plane that may reach beyond the frame. Const access is thread-safe.
struct FormMap {
    Vec2 origin{0};             ///< The rectangle's top left corner, in pixels of the frame.
    LatticeField displacement;  ///< By place less `origin`: from there to the flat place, px.

    /// The displacement of a place of the reference frame; beyond the rectangle it goes on
    /// linearly.
    [[nodiscard]] Vec2 at(Vec2 pixel) const { return displacement.at(pixel - origin); }
};

}  // namespace weft

#pragma once
#include <cstdint>

#include "engine/motion/lattice_field.h"

namespace weft {

/// What a form was found from, and how sure it is.
struct FormFinding {
    enum class Source : std::uint8_t {
        kNone,    ///< Nothing: the surface stays flat.
        kPass,    ///< A renderer's pass.
        kMotion,  ///< The motion of a rigid thing.
        kShape    ///< A shape or strokes that were drawn.
    };
    Source source = Source::kNone;
    bool plane = false;                      ///< A plane, not a curved surface.
    int frames = 0;                          ///< That show it.
    float belief = 1;                        ///< How much of it is likely to be there, 0–1.
    float tilt_deg = 0, tilt_error_deg = 0;  ///< Of a plane or of motion, in the middle.
    float fov_deg = 0;                       ///< Horizontal; of motion or a shape.
    bool operator==(const FormFinding&) const = default;
};

/// Where the places of a surface lie when it is laid flat, over a rectangle of the reference
/// frame's plane that may reach beyond the frame. Const access is thread-safe.
struct FormMap {
    Vec2 origin{0};             ///< The rectangle's top left corner, in pixels of the frame.
    LatticeField displacement;  ///< By place less `origin`: from there to the flat place, px.
    FormFinding finding = {};

    /// The displacement of a place of the reference frame; beyond the rectangle it goes on
    /// linearly.
    [[nodiscard]] Vec2 at(Vec2 pixel) const { return displacement.at(pixel - origin); }
};

}  // namespace weft

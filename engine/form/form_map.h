#pragma once
#include <cstdint>

#include "engine/core/pixel_aspect.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// What a form was found from, and how sure it is.
struct FormFinding {
    enum class Source : std::uint8_t {
        kNone,     ///< Nothing: the surface stays flat.
        kPass,     ///< A renderer's pass.
        kMotion,   ///< The motion of a rigid thing.
        kShape,    ///< A shape or strokes that were drawn.
        kOutline,  ///< Inflated from the outline.
        kLines     ///< The straight lines of the reference frame, in perspective.
    };
    Source source = Source::kNone;
    bool plane = false;                      ///< A plane, not a curved surface.
    int frames = 0;                          ///< Whose motion or pass shows it.
    float belief = 1;                        ///< How much of it is likely to be there, 0–1.
    float tilt_deg = 0, tilt_error_deg = 0;  ///< Of a plane or of motion, in the middle.
    float fov_deg = 0;                       ///< Horizontal; of motion, lines or a shape.
    float fov_error_deg = 0;                 ///< 0: not known, or not asked.
    std::uint8_t fov_regions = 0;  ///< Of the shot, whose motion decided it together; 0: its own.
    bool no_parallax = false;      ///< The camera only turns or zooms, so motion tells no form.
    /// How much of the displacement is to be laid: a plane is found as far tilted as is believed.
    [[nodiscard]] float laid_share() const { return plane ? 1 : belief; }
    bool operator==(const FormFinding&) const = default;
};

/// Where the places of a surface lie when it is laid flat, over a rectangle of the reference
/// frame's plane that may reach beyond the frame. All in unsqueezed pixels. Const access is
/// thread-safe.
struct FormMap {
    Vec2 origin{0};             ///< The rectangle's top left corner on the frame.
    LatticeField displacement;  ///< By place less `origin`: from there to the flat place, px.
    FormFinding finding = {};
    /// The surface in front of the camera, by place less `origin`: ln of its depth, up to a
    /// constant unless a pass gives its unit, and how well that is known, 0 to 1. Empty: not known.
    LatticeField relief = {};
    float relief_fov_deg = 0;  ///< Horizontal field of view in which it is seen.
    PixelAspect aspect = {};   ///< Of the plate.

    /// The displacement of an unsqueezed place of the reference frame; beyond the rectangle it goes
    /// on linearly.
    [[nodiscard]] Vec2 at(Vec2 unsqueezed) const { return displacement.at(unsqueezed - origin); }
};

}  // namespace weft

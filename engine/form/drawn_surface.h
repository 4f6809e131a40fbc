#pragma once
// The surface that a drawn shape stands for, in front of the camera.

#include <optional>
#include <variant>
#include <vector>

#include "engine/core/error.h"
#include "engine/form/form_guide.h"
#include "engine/form/metric_field.h"
#include "engine/form/view_camera.h"

namespace weft {

/// A plane n · P = 1 in view space.
struct DrawnPlane {
    glm::dvec3 normal{0, 0, 1};
};
/// All points at a distance from an axis.
struct DrawnCylinder {
    glm::dvec3 origin{0}, axis{0};
    double radius = 1;
};
struct DrawnCone {
    glm::dvec3 apex{0}, axis{0};  ///< The axis runs from the apex into it.
    double squared_cosine = 1;    ///< Of half the angle at the apex.
};
struct DrawnBall {
    glm::dvec3 centre{0};
    double radius = 1;
};

/// What is known of a camera before a shape is drawn.
struct DrawnCamera {
    Size picture;
    std::optional<double> fov_deg = {};  ///< Horizontal; empty: as they are common.
};

/// A drawn surface, as the camera sees it. The unit of length is arbitrary. Immutable.
struct DrawnSurface {
    ViewCamera camera;
    std::variant<DrawnPlane, DrawnCylinder, DrawnCone, DrawnBall> body;
    double fov_deg = 0;                       ///< Horizontal: given, found or common.
    double tilt_deg = 0, tilt_error_deg = 0;  ///< Of a plane, against the picture.

    [[nodiscard]] bool is_plane() const { return std::holds_alternative<DrawnPlane>(body); }
    /// The first fundamental form where a pixel shows the surface; empty where it does not, or
    /// where the surface is seen too grazingly to tell.
    [[nodiscard]] std::optional<Metric> metric(Vec2 pixel) const;
};

/// The surface of a shape. A plane's corners give its normal and, as far as their perspective
/// tells, the focal length (plane_from_lines()). A cylinder without a tilt gets it from its
/// outlines: they lie in planes through the camera that touch it, and their intersection is its
/// direction. `shape` has passed check_form_guide(). Errors: Usage where its numbers contradict
/// each other. Deterministic everywhere; thread-safe.
[[nodiscard]] Expected<DrawnSurface> drawn_surface(const FormGuide& shape,
                                                   const DrawnCamera& camera);

/// The plane of strokes that are parallel on it; a second group is at right angles to the first.
/// Others of `strokes` do not count. Errors: Usage where the lines of a group cross, or where there
/// are three groups.
[[nodiscard]] Expected<DrawnSurface> drawn_plane(const std::vector<FormGuide>& strokes,
                                                 const DrawnCamera& camera);

}  // namespace weft

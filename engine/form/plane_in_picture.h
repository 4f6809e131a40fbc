#pragma once
// The plane that one picture shows in perspective.

#include <optional>
#include <vector>

#include "engine/form/manhattan_search.h"
#include "engine/form/rigid_surface.h"

namespace weft {

/// What the straight lines of a whole picture tell of its directions and its lens.
struct ScenePerspective {
    struct Way {
        ManhattanFit fit;
        double share = 0;  ///< Of the belief.
    };
    std::vector<Way> ways;  ///< Likely ones, best first; empty: the lines tell none.
    TangentBelief lens;     ///< With what was believed before.
};

/// `lines`: picture_lines(), longest first. Bit-identical everywhere; thread-safe.
[[nodiscard]] ScenePerspective scene_perspective(const std::vector<PictureLine>& lines,
                                                 Size picture, const TangentBelief& lens);

/// A plane that explains a surface's lines, and how far that is to be believed; see RigidFit.
struct PictureFit {
    RigidSurface surface;
    Vec2 along{1, 0};   ///< At its centre, px: a direction of the picture in which its lines run.
    double belief = 0;  ///< How much of the form is likely to be there, 0–1.
    double log_stretch = 0, error = 0;        ///< ln stretch of the flat picture, its error.
    double tilt_deg = 0, tilt_error_deg = 0;  ///< At the centre, against the picture.
    double fov_deg = 0, fov_error_deg = 0;    ///< Horizontal.
    double explained = 0;                     ///< The share of its lines, by weight.
    double evidence = 0;                      ///< ln, of its lines, next to lines at any angle.

    /// Whether there is enough for the plane to be laid; a wrong one is worse than none.
    [[nodiscard]] bool holds(double least_belief) const;
};

/// The most likely plane of a surface whose lines are parallel or at right angles on it, as joints,
/// planks, kerbs and the edges of tables are: one that faces along an axis of the scene, or another
/// one. A plane that the matte shows beyond its horizon is none. Competing planes, the covariance
/// and the chance that it is no plane make up the error. `lines`: lines_on() of `matte` (255
/// inside; at least one pixel). Empty where nothing speaks for any. Bit-identical everywhere;
/// thread-safe.
[[nodiscard]] std::optional<PictureFit> plane_in_picture(const ScenePerspective& scene,
                                                         const std::vector<PictureLine>& lines,
                                                         ViewU8x1 matte);

}  // namespace weft

#pragma once
// Where a rigid thing of known shape stands before the camera. Internal to the folder.

#include <Eigen/Dense>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/form/rigid_bundle.h"
#include "engine/form/view_camera.h"

namespace weft {

/// A place in the reference frame's view space, and where a frame shows it (px).
struct SeenPlace {
    Eigen::Vector3d place;
    Vec2 frame;
};

/// A small rotation by a vector of radians, exactly orthonormal (Cayley).
[[nodiscard]] Eigen::Matrix3d rotation_by(const Eigen::Vector3d& w);

/// The pose that shows places where they are seen: errors of their projection, bounded at five
/// `sigma_px` (Geman & McClure 1985), by Levenberg–Marquardt from several starts. At least four
/// places.
[[nodiscard]] RigidPose pose_of(const std::vector<SeenPlace>& seen, const ViewCamera& camera,
                                double sigma_px);

/// How far a place is shown from where it is seen, px; not finite behind the camera.
[[nodiscard]] double error_px(const RigidPose& pose, const ViewCamera& camera,
                              const SeenPlace& seen);

}  // namespace weft

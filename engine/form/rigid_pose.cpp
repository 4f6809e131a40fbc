#include "engine/form/rigid_pose.h"

#include <cmath>
#include <limits>

#include "engine/form/eigen_types.h"

namespace weft {
namespace {

constexpr int kPoseSteps = 30;
constexpr double kStartTurn = 0.6;  // radians, of the further starts

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

Eigen::Vector2d place_error(const RigidPose& pose, const ViewCamera& camera,
                            const SeenPlace& seen) {
    const Vector3 q = pose.rotation * seen.place + pose.shift;
    if (!(q.z() > 1e-9)) return Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
    return {camera.centre.x + camera.focal_px * q.x() / q.z() - seen.frame.x,
            camera.centre.y + camera.focal_px * q.y() / q.z() - seen.frame.y};
}

double cost_of(const RigidPose& pose, const ViewCamera& camera, const std::vector<SeenPlace>& seen,
               double sigma_px) {
    double out = 0;
    for (const SeenPlace& s : seen) {
        const double square = place_error(pose, camera, s).squaredNorm() / (sigma_px * sigma_px);
        // Behind the camera nothing is seen.
        if (!std::isfinite(square)) return std::numeric_limits<double>::infinity();
        out += square / (1 + square / kOutlierSquare);
    }
    return out;
}

struct System {
    Matrix6 matrix = Matrix6::Zero();
    Vector6 right = Vector6::Zero();
};

System linearised(const RigidPose& pose, const ViewCamera& camera,
                  const std::vector<SeenPlace>& seen, double sigma_px) {
    System out;
    for (const SeenPlace& s : seen) {
        const Vector3 turned = pose.rotation * s.place;
        const Vector3 q = turned + pose.shift;
        const Eigen::Vector2d error = place_error(pose, camera, s);
        Eigen::Matrix<double, 2, 3> by_q;
        by_q << 1, 0, -q.x() / q.z(), 0, 1, -q.y() / q.z();
        by_q *= camera.focal_px / q.z();
        Matrix3 cross;
        cross << 0, -turned.z(), turned.y(), turned.z(), 0, -turned.x(), -turned.y(), turned.x(), 0;
        Eigen::Matrix<double, 2, 6> by_pose;
        by_pose.leftCols<3>() = -by_q * cross;
        by_pose.rightCols<3>() = by_q;
        const double bound = 1 + error.squaredNorm() / (sigma_px * sigma_px) / kOutlierSquare;
        const double w = 1 / (bound * bound);
        out.matrix += w * by_pose.transpose() * by_pose;
        out.right -= w * by_pose.transpose() * error;
    }
    return out;
}

// Descends from a pose; returns the cost reached.
double descend(RigidPose& pose, const ViewCamera& camera, const std::vector<SeenPlace>& seen,
               double sigma_px) {
    double cost = cost_of(pose, camera, seen, sigma_px), damping = 1e-3;
    for (int step = 0; step < kPoseSteps && std::isfinite(cost); ++step) {
        const System system = linearised(pose, camera, seen, sigma_px);
        double gain = -1;
        while (gain < 0 && damping < 1e8) {
            Matrix6 matrix = system.matrix;
            matrix.diagonal() *= 1 + damping;
            matrix.diagonal().array() += 1e-12 * system.matrix.trace();
            const Vector6 move = matrix.ldlt().solve(system.right);
            const RigidPose next{rotation_by(move.head<3>()) * pose.rotation,
                                 pose.shift + move.tail<3>()};
            const double after = cost_of(next, camera, seen, sigma_px);
            damping = after < cost ? damping * 0.2 : damping * 8;
            if (!(after < cost)) continue;
            gain = cost - after;
            pose = next;
            cost = after;
        }
        if (gain < 1e-6 * (1 + cost)) break;
    }
    return cost;
}

}  // namespace

Matrix3 rotation_by(const Vector3& w) {
    const Vector3 h = 0.5 * w;
    Matrix3 cross;
    cross << 0, -h.z(), h.y(), h.z(), 0, -h.x(), -h.y(), h.x(), 0;
    const double s = 2 / (1 + h.squaredNorm());
    return Matrix3::Identity() + s * (cross + cross * cross);
}

RigidPose pose_of(const std::vector<SeenPlace>& seen, const ViewCamera& camera, double sigma_px) {
    Vector3 middle = Vector3::Zero();
    Vec2 shown(0);
    const auto count = static_cast<double>(seen.size());
    for (const SeenPlace& s : seen) {
        middle += s.place / count;
        shown += s.frame / static_cast<float>(count);
    }
    const glm::dvec3 ray = camera.ray(shown);
    // The middle stands where it is seen, as far away as on the reference frame.
    const Vector3 at = middle.z() * Vector3(ray.x, ray.y, ray.z);
    RigidPose best;
    double least = std::numeric_limits<double>::infinity();
    for (const Vector3& turn :
         {Vector3(0, 0, 0), Vector3(kStartTurn, 0, 0), Vector3(-kStartTurn, 0, 0),
          Vector3(0, kStartTurn, 0), Vector3(0, -kStartTurn, 0)}) {
        RigidPose pose{rotation_by(turn), Vector3::Zero()};
        pose.shift = at - pose.rotation * middle;
        // Coarsely first, so that no start is lost among what counts as outliers.
        descend(pose, camera, seen, 50 * sigma_px);
        const double cost = descend(pose, camera, seen, sigma_px);
        if (cost < least) least = cost, best = pose;
    }
    return best;
}

double error_px(const RigidPose& pose, const ViewCamera& camera, const SeenPlace& seen) {
    return place_error(pose, camera, seen).norm();
}

}  // namespace weft

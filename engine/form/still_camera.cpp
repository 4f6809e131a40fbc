#include "engine/form/still_camera.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "engine/form/eigen_types.h"
#include "engine/form/rigid_pose.h"

namespace weft {
namespace {

// Of how far the picture moves: what distortion and a rolling shutter leave of a turn.
constexpr double kLensError = 0.01;
// From what it explains. Cameras that pan and zoom leave 0.4 to 1.2, surfaces whose form was found
// rightly 7 to 53.
constexpr double kParallax = 1.5;
constexpr std::size_t kLeastTurnPairs = 6;
constexpr int kTurnSteps = 12;
// Horizontal fields of view of 17° to 77°.
constexpr double kFirstTangent = 0.3, kTangentStep = 0.1;
constexpr int kTangents = 14;

// The pictures of one frame and the reference frame in units of the long side, from the middle.
struct Pairs {
    std::vector<Eigen::Vector2d> reference, frame;
    double moved = 0;  // mean length
};

Pairs pairs_of(const FrameMatches& matches, Size picture) {
    const double side = std::max(picture.width, picture.height);
    const auto from_middle = [&](Vec2 p) {
        return Eigen::Vector2d((static_cast<double>(p.x) - 0.5 * picture.width) / side,
                               (static_cast<double>(p.y) - 0.5 * picture.height) / side);
    };
    Pairs out;
    for (std::size_t i = 0; i < matches.reference.size(); ++i) {
        out.reference.push_back(from_middle(matches.reference[i]));
        out.frame.push_back(from_middle(matches.frame[i]));
        out.moved += (out.frame.back() - out.reference.back()).norm();
    }
    out.moved /= static_cast<double>(std::max<std::size_t>(1, matches.reference.size()));
    return out;
}

// A turn and a zoom, and how the sum of squares changes with them.
struct Step {
    Matrix4 normal = Matrix4::Zero();
    Vector4 slope = Vector4::Zero();
    double squares = 0;
};

Step step_at(const Pairs& pairs, double tangent, const Eigen::Matrix3d& turn, double zoom) {
    Step out;
    for (std::size_t i = 0; i < pairs.reference.size(); ++i) {
        const Eigen::Vector2d at = tangent * pairs.reference[i];
        const Vector3 ray = turn * Vector3(at.x(), at.y(), 1);
        if (!(ray.z() > 0.05)) {
            out.squares = std::numeric_limits<double>::infinity();
            return out;
        }
        const double x = ray.x() / ray.z(), y = ray.y() / ray.z(), scale = zoom / tangent;
        const Vector4 along_x = scale * Vector4(-x * y, 1 + x * x, -y, x / zoom);
        const Vector4 along_y = scale * Vector4(-1 - y * y, x * y, x, y / zoom);
        const double left_x = scale * x - pairs.frame[i].x(),
                     left_y = scale * y - pairs.frame[i].y();
        out.normal += along_x * along_x.transpose() + along_y * along_y.transpose();
        out.slope += left_x * along_x + left_y * along_y;
        out.squares += left_x * left_x + left_y * left_y;
    }
    return out;
}

// Root mean square of what is left, by Levenberg–Marquardt from no turn and no zoom.
double residual(const Pairs& pairs, double tangent) {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    double zoom = 1, damping = 1e-4;
    Step now = step_at(pairs, tangent, turn, zoom);
    for (int k = 0; k < kTurnSteps; ++k) {
        Matrix4 damped = now.normal;
        damped.diagonal() *= 1 + damping;
        const Vector4 by = damped.ldlt().solve(-now.slope);
        const Eigen::Matrix3d turned = rotation_by(by.head<3>()) * turn;
        const double zoomed = zoom + by[3];
        const Step next = zoomed > 0.05 ? step_at(pairs, tangent, turned, zoomed)
                                        : Step{{}, {}, std::numeric_limits<double>::infinity()};
        if (next.squares < now.squares) {
            turn = turned, zoom = zoomed, now = next, damping *= 0.1;
        } else {
            damping *= 10;
        }
    }
    return std::sqrt(now.squares / static_cast<double>(pairs.reference.size()));
}

}  // namespace

double beyond_still_camera(const std::vector<FrameMatches>& frames, Size picture) {
    std::vector<Pairs> all;
    for (const FrameMatches& matches : frames)
        if (matches.reference.size() >= kLeastTurnPairs) all.push_back(pairs_of(matches, picture));
    double least = std::numeric_limits<double>::infinity();
    if (all.empty()) return least;
    for (int k = 0; k < kTangents; ++k) {
        const double tangent = kFirstTangent + k * kTangentStep;
        double squares = 0;
        for (const Pairs& pairs : all) {
            const double off = residual(pairs, tangent) / (kTrackError + kLensError * pairs.moved);
            squares += off * off;
        }
        least = std::min(least, std::sqrt(squares / static_cast<double>(all.size())));
    }
    return least;
}

bool shows_parallax(const std::vector<FrameMatches>& frames, Size picture) {
    return beyond_still_camera(frames, picture) >= kParallax;
}

}  // namespace weft

#include "engine/form/rigid_bundle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "engine/form/eigen_types.h"
#include "engine/form/rigid_pose.h"

namespace weft {
namespace {

constexpr double kLeastTangent = 0.15, kMostTangent = 3;
constexpr double kEnough = 1e-4;  // gain of a step, in units of the cost

// The error bounded: s / (1 + s / kOutlierSquare), and its slope.
double bounded_error(double square) {
    return square / (1 + square / kOutlierSquare);
}
double slope_of_bounded(double square) {
    const double d = 1 + square / kOutlierSquare;
    return 1 / (d * d);
}

// A place of the reference frame as a ray, and without the tangent.
Vector3 offset_of(const RigidSurface& s, Vec2 place) {
    return {(static_cast<double>(place.x) - s.middle.x) / s.long_side,
            (static_cast<double>(place.y) - s.middle.y) / s.long_side, 0};
}
Vector3 ray_of(const RigidSurface& s, Vec2 place) {
    return s.tangent * offset_of(s, place) + Vector3::UnitZ();
}

double nearness_by(const RigidSurface& s, const double* terms) {
    double out = 1 + s.slope_x * terms[0] + s.slope_y * terms[1];
    for (std::size_t k = 0; k < s.relief.size(); ++k)
        out += s.relief[k] * terms[2 + k];
    return out;
}

// The error of one match, px; not finite behind the camera.
Eigen::Vector2d match_error(const RigidSurface& s, const RigidPose& pose, double rho,
                            Vec2 reference, Vec2 frame) {
    const Vector3 q = pose.rotation * ray_of(s, reference) + rho * pose.shift;
    const double focal = s.long_side / s.tangent;
    if (!(q.z() > 1e-3 && rho > 1e-3))
        return Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
    return {s.middle.x + focal * q.x() / q.z() - frame.x,
            s.middle.y + focal * q.y() / q.z() - frame.y};
}

}  // namespace

RigidBundle::RigidBundle(const std::vector<FrameMatches>& frames, RigidSurface surface,
                         std::vector<RigidPose> poses, const RigidPrior& prior, double sigma_px)
    : frames_(&frames),
      surface_(std::move(surface)),
      poses_(std::move(poses)),
      prior_(prior),
      sigma_px_(sigma_px) {
    const std::size_t count = 2 + surface_.relief.size();
    terms_.resize(frames.size());
    for (std::size_t f = 0; f < frames.size(); ++f) {
        terms_[f].resize(count * frames[f].reference.size());
        for (std::size_t i = 0; i < frames[f].reference.size(); ++i)
            surface_.nearness_terms(frames[f].reference[i], &terms_[f][count * i]);
    }
    cost_ = cost_of(surface_, poses_);
}

Eigen::VectorXd RigidBundle::prior_weights() const {
    Eigen::VectorXd out(shared_count());
    out.head(2).setConstant(1 / (prior_.slope * prior_.slope));
    for (std::size_t k = 0; k < surface_.relief.size(); ++k) {
        const Vec2i order = RigidSurface::orders()[k];
        const double by = 0.25 * (order.x * order.x + order.y * order.y) / prior_.relief;
        out[static_cast<Eigen::Index>(2 + k)] = by * by;
    }
    out[out.size() - 1] = 1 / (prior_.tangent_deviation * prior_.tangent_deviation);
    return out;
}

Eigen::VectorXd RigidBundle::prior_left(const RigidSurface& surface) const {
    Eigen::VectorXd out(shared_count());
    out[0] = -surface.slope_x;
    out[1] = -surface.slope_y;
    for (std::size_t k = 0; k < surface.relief.size(); ++k)
        out[static_cast<Eigen::Index>(2 + k)] = -surface.relief[k];
    out[out.size() - 1] = prior_.tangent - surface.tangent;
    return out;
}

double RigidBundle::prior_cost(const RigidSurface& surface) const {
    const Eigen::VectorXd left = prior_left(surface);
    return left.dot(prior_weights().asDiagonal() * left);
}

double RigidBundle::cost_of(const RigidSurface& surface,
                            const std::vector<RigidPose>& poses) const {
    const std::size_t count = 2 + surface.relief.size();
    double out = prior_cost(surface);
    for (std::size_t f = 0; f < frames_->size(); ++f) {
        const FrameMatches& m = (*frames_)[f];
        double sum = 0;
        for (std::size_t i = 0; i < m.reference.size(); ++i) {
            const double rho = nearness_by(surface, &terms_[f][count * i]);
            const double square =
                match_error(surface, poses[f], rho, m.reference[i], m.frame[i]).squaredNorm() /
                (sigma_px_ * sigma_px_);
            // Behind the camera nothing is seen.
            if (!std::isfinite(square)) return std::numeric_limits<double>::infinity();
            sum += bounded_error(square);
        }
        out += kIndependent / (2 * static_cast<double>(m.reference.size())) * sum;
    }
    return out;
}

RigidBundle::System RigidBundle::linearised() const {
    const int shared = shared_count();
    const std::size_t count = 2 + surface_.relief.size();
    System out{
        {}, prior_weights().asDiagonal(), -prior_weights().cwiseProduct(prior_left(surface_))};
    const double focal = surface_.long_side / surface_.tangent;
    Eigen::Matrix<double, 2, Eigen::Dynamic> by_shared(2, shared);
    for (std::size_t f = 0; f < frames_->size(); ++f) {
        const FrameMatches& m = (*frames_)[f];
        FrameSystem system{Eigen::Matrix<double, 6, 6>::Zero(), Eigen::Matrix<double, 6, 1>::Zero(),
                           Eigen::MatrixXd::Zero(6, shared)};
        const double each =
            kIndependent / (2 * static_cast<double>(m.reference.size())) / (sigma_px_ * sigma_px_);
        for (std::size_t i = 0; i < m.reference.size(); ++i) {
            const double* terms = &terms_[f][count * i];
            const double rho = nearness_by(surface_, terms);
            const Eigen::Vector2d error =
                match_error(surface_, poses_[f], rho, m.reference[i], m.frame[i]);
            const Vector3 turned = poses_[f].rotation * ray_of(surface_, m.reference[i]);
            const Vector3 q = turned + rho * poses_[f].shift;
            // By a step of q.
            Eigen::Matrix<double, 2, 3> by_q;
            by_q << 1, 0, -q.x() / q.z(), 0, 1, -q.y() / q.z();
            by_q *= focal / q.z();
            Eigen::Matrix<double, 2, 6> by_pose;
            Matrix3 cross;
            cross << 0, -turned.z(), turned.y(), turned.z(), 0, -turned.x(), -turned.y(),
                turned.x(), 0;
            by_pose.leftCols<3>() = -by_q * cross;
            by_pose.rightCols<3>() = rho * by_q;
            const Eigen::Vector2d by_nearness = by_q * poses_[f].shift;
            for (std::size_t k = 0; k < count; ++k)
                by_shared.col(static_cast<Eigen::Index>(k)) = terms[k] * by_nearness;
            by_shared.col(shared - 1) =
                by_q * (poses_[f].rotation * offset_of(surface_, m.reference[i])) -
                focal / (surface_.tangent * q.z()) * q.head<2>();
            const double w = each * slope_of_bounded(error.squaredNorm() / (sigma_px_ * sigma_px_));
            system.poses += w * by_pose.transpose() * by_pose;
            system.right += w * by_pose.transpose() * error;
            system.mixed += w * by_pose.transpose() * by_shared;
            out.shared += w * by_shared.transpose() * by_shared;
            out.right += w * by_shared.transpose() * error;
        }
        out.frames.push_back(std::move(system));
    }
    return out;
}

void RigidBundle::descend(int most_steps) {
    if (!std::isfinite(cost_)) return;
    double damping = 1e-3;
    for (int step = 0; step < most_steps; ++step) {
        const System system = linearised();
        bool better = false;
        double gain = 0;
        while (!better && damping < 1e8) {
            Eigen::MatrixXd reduced = system.shared;
            reduced.diagonal() *= 1 + damping;
            Eigen::VectorXd right = -system.right;
            std::vector<Eigen::Matrix<double, 6, 6>> inverses;
            inverses.reserve(system.frames.size());
            for (const FrameSystem& f : system.frames) {
                Eigen::Matrix<double, 6, 6> poses = f.poses;
                poses.diagonal() *= 1 + damping;
                poses.diagonal().array() += 1e-9;
                inverses.emplace_back(poses.inverse());
                const Eigen::MatrixXd across = f.mixed.transpose() * inverses.back();
                reduced -= across * f.mixed;
                right += across * f.right;
            }
            const Eigen::VectorXd move = reduced.ldlt().solve(right);
            const RigidSurface surface = moved(move);
            std::vector<RigidPose> poses = poses_;
            for (std::size_t f = 0; f < poses.size(); ++f) {
                const Eigen::Matrix<double, 6, 1> turn =
                    -inverses[f] * (system.frames[f].right + system.frames[f].mixed * move);
                poses[f].rotation = rotation_by(turn.head<3>()) * poses[f].rotation;
                poses[f].shift += turn.tail<3>();
            }
            const double cost = cost_of(surface, poses);
            better = cost < cost_;
            if (better) {
                gain = cost_ - cost;
                surface_ = surface;
                poses_ = std::move(poses);
                cost_ = cost;
            }
            damping = better ? std::max(damping * 0.2, 1e-9) : damping * 8;
        }
        if (!better || gain < kEnough) return;
    }
}

RigidSurface RigidBundle::moved(const Eigen::VectorXd& step) const {
    RigidSurface out = surface_;
    out.slope_x += step[0];
    out.slope_y += step[1];
    for (std::size_t k = 0; k < out.relief.size(); ++k)
        out.relief[k] += step[static_cast<Eigen::Index>(2 + k)];
    out.tangent = std::clamp(out.tangent + step[step.size() - 1], kLeastTangent, kMostTangent);
    return out;
}

double RigidBundle::residual_px() const {
    const std::size_t count = 2 + surface_.relief.size();
    std::vector<double> squares;
    for (std::size_t f = 0; f < frames_->size(); ++f) {
        const FrameMatches& m = (*frames_)[f];
        for (std::size_t i = 0; i < m.reference.size(); ++i) {
            const double rho = nearness_by(surface_, &terms_[f][count * i]);
            squares.push_back(
                match_error(surface_, poses_[f], rho, m.reference[i], m.frame[i]).squaredNorm());
        }
    }
    if (squares.empty()) return 0;
    const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
    std::nth_element(squares.begin(), middle, squares.end());
    return std::sqrt(*middle);
}

Eigen::MatrixXd RigidBundle::information() const {
    const System system = linearised();
    Eigen::MatrixXd out = system.shared;
    for (const FrameSystem& f : system.frames) {
        Eigen::Matrix<double, 6, 6> poses = f.poses;
        poses.diagonal().array() += 1e-9;
        out -= f.mixed.transpose() * poses.inverse() * f.mixed;
    }
    return out;
}

}  // namespace weft

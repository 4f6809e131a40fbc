#include "engine/form/camera_rotation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace weft {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Seen {
    Vector3d place;
    Vector3d ray;  // of depth 1; x to the right, y down
};

struct Camera {
    Matrix3d rotation;  // from the places' axes into view space
    Vector3d shift;
};

std::vector<Seen> seen_places(ViewF3 places, const ViewCamera& camera) {
    constexpr int kAcross = 96;  // places on the longer side
    const int step = std::max(1, std::max(places.width(), places.height()) / kAcross);
    std::vector<Seen> out;
    for (int y = step / 2; y < places.height(); y += step) {
        for (int x = step / 2; x < places.width(); x += step) {
            const float* p = places.pixel(x, y);
            if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) continue;
            const glm::dvec3 ray =
                camera.ray({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
            out.push_back({{p[0], p[1], p[2]}, {ray.x, ray.y, ray.z}});
        }
    }
    return out;
}

// The places' own axes, the widest first, and their deviations along them.
struct Spread {
    Vector3d centre = Vector3d::Zero();
    Matrix3d axes;  // columns
    Vector3d deviation;
};

Spread spread_of(const std::vector<Seen>& seen) {
    Spread out;
    for (const Seen& s : seen)
        out.centre += s.place / static_cast<double>(seen.size());
    Matrix3d covariance = Matrix3d::Zero();
    for (const Seen& s : seen)
        covariance += (s.place - out.centre) * (s.place - out.centre).transpose();
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(covariance /
                                                         static_cast<double>(seen.size()));
    out.axes = solver.eigenvectors().rowwise().reverse();
    out.deviation = solver.eigenvalues().reverse().cwiseMax(0).cwiseSqrt();
    if (out.axes.determinant() < 0) out.axes.col(2) *= -1;
    return out;
}

// The 3×n matrix M with ray ~ M (q, 1), by least squares; q are the first n − 1 coordinates along
// the axes, in deviations.
Eigen::MatrixXd projection_of(const std::vector<Seen>& seen, const Spread& spread, int n) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(3 * n, 3 * n);
    for (const Seen& s : seen) {
        Eigen::VectorXd q = Eigen::VectorXd::Ones(n);
        const Vector3d along = spread.axes.transpose() * (s.place - spread.centre);
        for (int k = 0; k + 1 < n; ++k)
            q[k] = along[k] / spread.deviation[k];
        Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2, 3 * n);
        rows.block(0, 0, 1, n) = -q.transpose();
        rows.block(0, 2 * n, 1, n) = s.ray.x() * q.transpose();
        rows.block(1, n, 1, n) = -q.transpose();
        rows.block(1, 2 * n, 1, n) = s.ray.y() * q.transpose();
        normal += rows.transpose() * rows;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(normal);
    const Eigen::VectorXd least = solver.eigenvectors().col(0);
    Eigen::MatrixXd out(3, n);
    for (int row = 0; row < 3; ++row)
        out.row(row) = least.segment(row * n, n).transpose();
    // In front of the camera; the mean place has q = 0.
    return out(2, n - 1) < 0 ? Eigen::MatrixXd(-out) : out;
}

Matrix3d nearest_rotation(const Matrix3d& m) {
    const Eigen::JacobiSVD<Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Matrix3d u = svd.matrixU();
    if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) *= -1;
    return u * svd.matrixV().transpose();
}

Camera camera_from(const std::vector<Seen>& seen, const Spread& spread) {
    constexpr double kFlat = 1e-3;
    const bool flat = spread.deviation[2] < kFlat * spread.deviation[0];
    const int n = flat ? 3 : 4;
    const Eigen::MatrixXd m = projection_of(seen, spread, n);
    Matrix3d turned;  // by the axes, up to one scale
    for (int k = 0; k + 1 < n; ++k)
        turned.col(k) = m.col(k) / spread.deviation[k];
    const double scale = 0.5 * (turned.col(0).norm() + turned.col(1).norm());
    if (flat) turned.col(2) = turned.col(0).cross(turned.col(1)) / scale;
    const Matrix3d rotation = nearest_rotation(turned / scale) * spread.axes.transpose();
    return {rotation, m.col(n - 1) / scale - rotation * spread.centre};
}

double median_miss_px(const std::vector<Seen>& seen, const Camera& at, double focal_px) {
    std::vector<double> misses;
    for (const Seen& s : seen) {
        const Vector3d p = at.rotation * s.place + at.shift;
        misses.push_back(p.z() > 0 ? focal_px * (p / p.z() - s.ray).norm() : 1e30);
    }
    const auto middle = misses.begin() + static_cast<std::ptrdiff_t>(misses.size() / 2);
    std::nth_element(misses.begin(), middle, misses.end());
    return *middle;
}

}  // namespace

std::optional<std::array<double, 9>> camera_rotation(ViewF3 places, const ViewCamera& camera,
                                                     double most_px) {
    constexpr std::size_t kLeast = 24;
    constexpr double kLine = 1e-3;
    const std::vector<Seen> seen = seen_places(places, camera);
    if (seen.size() < kLeast) return std::nullopt;
    const Spread spread = spread_of(seen);
    if (!(spread.deviation[1] > kLine * spread.deviation[0])) return std::nullopt;
    const Camera at = camera_from(seen, spread);
    if (!(median_miss_px(seen, at, camera.focal_px) <= most_px)) return std::nullopt;
    std::array<double, 9> out{};
    for (int row = 0; row < 3; ++row)
        for (int col = 0; col < 3; ++col)
            out[static_cast<std::size_t>(3 * row + col)] =
                row == 0 ? at.rotation(row, col) : -at.rotation(row, col);
    return out;
}

}  // namespace weft

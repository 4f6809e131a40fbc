#include "engine/form/homography_fit.h"

#include <cstddef>

namespace weft {

std::optional<Eigen::Matrix3d> fit_homography(const std::vector<Eigen::Vector2d>& from,
                                              const std::vector<Eigen::Vector2d>& to) {
    if (from.size() < 4) return std::nullopt;
    using Row = Eigen::Matrix<double, 1, 9>;
    Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
    for (std::size_t i = 0; i < from.size(); ++i) {
        const double x = from[i].x(), y = from[i].y(), u = to[i].x(), v = to[i].y();
        Row a, b;
        a << x, y, 1, 0, 0, 0, -u * x, -u * y, -u;
        b << 0, 0, 0, x, y, 1, -v * x, -v * y, -v;
        normal += a.transpose() * a + b.transpose() * b;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(normal);
    // The second smallest tells whether there is one solution only.
    if (!(solver.eigenvalues()[1] > 1e-12 * solver.eigenvalues()[8])) return std::nullopt;
    const Eigen::Matrix<double, 9, 1> h = solver.eigenvectors().col(0);
    Eigen::Matrix3d out;
    out << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], h[8];
    return out;
}

}  // namespace weft

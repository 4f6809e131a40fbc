#include "engine/form/flatten.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/form/flat_places.h"

namespace weft {
namespace {

constexpr int kMostSteps = 40;
constexpr double kEnoughGain = 1e-4;  // relative gain of a step
constexpr double kFollows = 0.01;     // weight of cells without evidence
constexpr double kProximal = 1e-4;    // of the mean diagonal: keeps translation and rotation
constexpr double kShortOfFlip = 0.9;

using Matrix2 = Eigen::Matrix2d;
using Sparse = Eigen::SparseMatrix<double>;

// A triangle of nodes with the gradients of their hat functions on the surface, by unit length.
struct Triangle {
    std::array<int, 3> node{};
    Eigen::Matrix<double, 2, 3> gradient;
    double weight = 0;  // its area on the surface
};

Matrix2 root_of(const Metric& m) {
    // For 2 × 2: √G = (G + √det G · I) / √(tr G + 2 √det G).
    const double d = std::sqrt(m.determinant());
    const double t = std::sqrt(m.xx + m.yy + 2 * d);
    Matrix2 out;
    out << (m.xx + d) / t, m.xy / t, m.xy / t, (m.yy + d) / t;
    return out;
}

class Flattening {
  public:
    explicit Flattening(const MetricField& field);
    void solve();
    [[nodiscard]] const Eigen::VectorXd& places() const { return u_; }

  private:
    [[nodiscard]] int node(int i, int j) const { return j * nodes_.width + i; }
    void add_triangle(const Matrix2& root, const std::array<Vec2i, 3>& corners, double weight);
    void find_pattern();
    [[nodiscard]] static Matrix2 slope_of(const Triangle& t, const Eigen::VectorXd& u);
    [[nodiscard]] double energy(const Eigen::VectorXd& u) const;
    void assemble();
    // The longest share of a step that turns no triangle over.
    [[nodiscard]] double longest(const Eigen::VectorXd& step) const;

    Size nodes_;
    int spacing_;
    std::vector<Triangle> triangles_;
    std::vector<std::array<double*, 36>> entries_;  // of a triangle's block in the matrix
    Eigen::VectorXd u_, right_;
    Sparse matrix_;
    Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::AMDOrdering<int>> solver_;
};

Flattening::Flattening(const MetricField& field)
    : nodes_{field.cells().width + 1, field.cells().height + 1}, spacing_(field.spacing()) {
    const Size cells = field.cells();
    triangles_.reserve(2 * static_cast<std::size_t>(cells.width) *
                       static_cast<std::size_t>(cells.height));
    for (int j = 0; j < cells.height; ++j) {
        for (int i = 0; i < cells.width; ++i) {
            const Matrix2 root = root_of(field.at(i, j));
            const double weight = field.evidence(i, j) > 0 ? 1.0 : kFollows;
            const Vec2i a{i, j}, b{i + 1, j}, c{i + 1, j + 1}, d{i, j + 1};
            // Diagonals in turn, so that none of the two directions is favoured.
            if ((i + j) % 2 == 0) {
                add_triangle(root, {a, b, c}, weight);
                add_triangle(root, {a, c, d}, weight);
            } else {
                add_triangle(root, {a, b, d}, weight);
                add_triangle(root, {b, c, d}, weight);
            }
        }
    }
    u_.resize(2 * static_cast<Eigen::Index>(nodes_.width) * nodes_.height);
    for (int j = 0; j < nodes_.height; ++j) {
        for (int i = 0; i < nodes_.width; ++i) {
            u_[2 * node(i, j)] = static_cast<double>(i) * spacing_;
            u_[2 * node(i, j) + 1] = static_cast<double>(j) * spacing_;
        }
    }
    find_pattern();
}

void Flattening::add_triangle(const Matrix2& root, const std::array<Vec2i, 3>& corners,
                              double weight) {
    const auto place = [&](const Vec2i& c) -> Eigen::Vector2d {
        return root * Eigen::Vector2d(c.x, c.y) * static_cast<double>(spacing_);
    };
    Matrix2 sides;
    sides.col(0) = place(corners[1]) - place(corners[0]);
    sides.col(1) = place(corners[2]) - place(corners[0]);
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k)
        t.node[k] = node(corners[k].x, corners[k].y);
    const Matrix2 inverse = sides.inverse();
    t.gradient.col(1) = inverse.row(0).transpose();
    t.gradient.col(2) = inverse.row(1).transpose();
    t.gradient.col(0) = -t.gradient.col(1) - t.gradient.col(2);
    t.weight = 0.5 * weight * sides.determinant();
    triangles_.push_back(t);
}

Matrix2 Flattening::slope_of(const Triangle& t, const Eigen::VectorXd& u) {
    Matrix2 out = Matrix2::Zero();
    for (int k = 0; k < 3; ++k)
        out +=
            u.segment<2>(2 * t.node[static_cast<std::size_t>(k)]) * t.gradient.col(k).transpose();
    return out;
}

// Two rows for a node: its place's x and y. The lower half is stored.
void Flattening::find_pattern() {
    std::vector<Eigen::Triplet<double>> all;
    all.reserve(36 * triangles_.size() + static_cast<std::size_t>(u_.size()));
    const auto each = [](const Triangle& t, auto&& visit) {
        int entry = 0;
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t l = 0; l < 3; ++l)
                for (int m = 0; m < 2; ++m)
                    for (int n = 0; n < 2; ++n)
                        visit(entry++, 2 * t.node[k] + m, 2 * t.node[l] + n);
    };
    for (const Triangle& t : triangles_)
        each(t, [&](int /*entry*/, int row, int column) {
            if (row >= column) all.emplace_back(row, column, 0.0);
        });
    for (int k = 0; k < u_.size(); ++k)
        all.emplace_back(k, k, 0.0);
    matrix_.resize(u_.size(), u_.size());
    matrix_.setFromTriplets(all.begin(), all.end());
    matrix_.makeCompressed();
    entries_.resize(triangles_.size());
    for (std::size_t i = 0; i < triangles_.size(); ++i)
        each(triangles_[i], [&](int entry, int row, int column) {
            entries_[i][static_cast<std::size_t>(entry)] =
                row >= column ? &matrix_.coeffRef(row, column) : nullptr;
        });
    solver_.analyzePattern(matrix_);
}

double Flattening::energy(const Eigen::VectorXd& u) const {
    double sum = 0;
    for (const Triangle& t : triangles_) {
        const Matrix2 j = slope_of(t, u);
        const double d = j.determinant();
        if (!(d > 0)) return std::numeric_limits<double>::infinity();
        // ‖J‖² + ‖J⁻¹‖²
        sum += t.weight * j.squaredNorm() * (1 + 1 / (d * d));
    }
    return sum;
}

// The rotation nearest to a slope, and the weights under which a quadratic has the energy's own
// gradient there (Rabinovich et al. 2017, table 1: S_W = √((s − s⁻³) / (s − 1))).
struct Reweighted {
    Matrix2 rotation, squared;  // WᵀW
};

Reweighted reweighted(const Matrix2& slope) {
    const Matrix2 product = slope * slope.transpose();
    const double half = 0.5 * product.trace(), determinant = slope.determinant();
    const double root = std::sqrt(std::max(0.0, half * half - determinant * determinant));
    const auto square_of = [](double s) {
        return (1 + s) * (1 + s * s) / (s * s * s);  // (s − s⁻³) / (s − 1)
    };
    const double larger = std::sqrt(half + root), smaller = determinant / larger;
    const double of_larger = square_of(larger), of_smaller = square_of(smaller);
    // The function of a symmetric matrix that takes these values at its two eigenvalues.
    const double apart = 2 * root;
    const double linear = apart > 1e-9 * half ? (of_larger - of_smaller) / apart : 0.0;
    Reweighted out;
    out.squared = linear * product + (of_larger - linear * (half + root)) * Matrix2::Identity();
    const double c = slope(0, 0) + slope(1, 1), d = slope(1, 0) - slope(0, 1);
    const double length = std::sqrt(c * c + d * d);
    out.rotation << c / length, -d / length, d / length, c / length;
    return out;
}

void Flattening::assemble() {
    std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0.0);
    right_ = Eigen::VectorXd::Zero(u_.size());
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const Triangle& t = triangles_[i];
        const Reweighted r = reweighted(slope_of(t, u_));
        const Eigen::Matrix3d products = t.weight * t.gradient.transpose() * t.gradient;
        const Matrix2 target = t.weight * r.squared * r.rotation;
        std::size_t entry = 0;
        for (int k = 0; k < 3; ++k) {
            right_.segment<2>(2 * t.node[static_cast<std::size_t>(k)]) +=
                target * t.gradient.col(k);
            for (int l = 0; l < 3; ++l)
                for (int m = 0; m < 2; ++m)
                    for (int n = 0; n < 2; ++n, ++entry)
                        if (double* at = entries_[i][entry])
                            *at += r.squared(m, n) * products(k, l);
        }
    }
    const double near = kProximal * matrix_.diagonal().mean();
    matrix_.diagonal().array() += near;
    right_ += near * u_;
}

double Flattening::longest(const Eigen::VectorXd& step) const {
    double most = std::numeric_limits<double>::infinity();
    for (const Triangle& t : triangles_) {
        const Matrix2 a = slope_of(t, u_), b = slope_of(t, step);
        // det(a + s b) = 0
        const double square = b.determinant(), constant = a.determinant();
        const double linear =
            a(0, 0) * b(1, 1) + a(1, 1) * b(0, 0) - a(0, 1) * b(1, 0) - a(1, 0) * b(0, 1);
        const double root = linear * linear - 4 * square * constant;
        if (root < 0) continue;
        // The smallest positive solution, without cancellation.
        const double q = -0.5 * (linear + std::copysign(std::sqrt(root), linear));
        for (const double s : {square != 0 ? q / square : -1.0, q != 0 ? constant / q : -1.0})
            if (s > 0) most = std::min(most, s);
    }
    return most;
}

void Flattening::solve() {
    double before = energy(u_);
    for (int k = 0; k < kMostSteps; ++k) {
        assemble();
        solver_.factorize(matrix_);
        if (solver_.info() != Eigen::Success) return;
        const Eigen::VectorXd step = solver_.solve(right_) - u_;
        double length = std::min(1.0, kShortOfFlip * longest(step));
        double after = energy(u_ + length * step);
        while (!(after < before) && length > 1e-6) {
            length *= 0.5;
            after = energy(u_ + length * step);
        }
        if (!(after < before)) return;
        u_ += length * step;
        const double gain = (before - after) / before;
        before = after;
        if (gain < kEnoughGain) return;
    }
}

}  // namespace

FormMap flat_from_reference(const MetricField& field) {
    Flattening flat(field);
    flat.solve();
    const Eigen::VectorXd& u = flat.places();
    std::vector<glm::dvec2> places;
    places.reserve(static_cast<std::size_t>(u.size()) / 2);
    for (Eigen::Index k = 0; k < u.size(); k += 2)
        places.emplace_back(u[k], u[k + 1]);
    return form_of_places(field, std::move(places));
}

}  // namespace weft

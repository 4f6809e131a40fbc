#include "engine/form/inflate.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace weft {
namespace {

constexpr int kNodes = 192;          // along the longer side of the matte's box
constexpr int kLeastNodes = 20;      // inside of it
constexpr int kSmoothings = 24;      // of k, over some nodes: its kinks are no shape
constexpr double kMostSlope = 4;     // of the height
constexpr double kMostHeight = 0.8;  // of the distance to the camera

enum class Edge { kInside, kTurns, kCut };

// Nodes in the middle of squares of pixels, over the box around the matte.
class Grid {
  public:
    Grid(ViewU8x1 matte, ViewU8x1 cut);

    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] int step() const { return step_; }
    [[nodiscard]] int inside() const { return inside_; }
    // The unknown of a node, −1 outside.
    [[nodiscard]] int unknown(int i, int j) const {
        if (i < 0 || j < 0 || i >= size_.width || j >= size_.height) return -1;
        return unknowns_[index(i, j)];
    }
    [[nodiscard]] Vec2 place(int i, int j) const {
        const auto at = [this](int k, int from) {
            return static_cast<float>(from) +
                   (static_cast<float>(k) + 0.5f) * static_cast<float>(step_);
        };
        return {at(i, box_.x0), at(j, box_.y0)};
    }
    // What lies between a node inside and its neighbour.
    [[nodiscard]] Edge edge(int i, int j, int di, int dj) const;

  private:
    [[nodiscard]] std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(size_.width) +
               static_cast<std::size_t>(i);
    }

    Recti box_{};
    Size picture_, size_;
    int step_ = 1, inside_ = 0;
    std::vector<int> unknowns_;
    std::vector<bool> cut_;
};

Recti box_of(ViewU8x1 matte) {
    Recti out{};
    for (int y = 0; y < matte.height(); ++y)
        for (int x = 0; x < matte.width(); ++x)
            if (matte.row(y)[x] >= 128) out = out.united({x, y, x + 1, y + 1});
    return out;
}

Grid::Grid(ViewU8x1 matte, ViewU8x1 cut) : box_(box_of(matte)), picture_(matte.size()) {
    step_ = std::max(1, std::max(box_.width(), box_.height()) / kNodes);
    size_ = {(box_.width() + step_ - 1) / step_, (box_.height() + step_ - 1) / step_};
    unknowns_.resize(static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height),
                     -1);
    cut_.resize(unknowns_.size());
    for (int j = 0; j < size_.height; ++j) {
        for (int i = 0; i < size_.width; ++i) {
            int covered = 0, all = 0;
            bool any_cut = false;
            for (int y = box_.y0 + j * step_; y < box_.y0 + (j + 1) * step_; ++y) {
                for (int x = box_.x0 + i * step_; x < box_.x0 + (i + 1) * step_; ++x) {
                    ++all;
                    if (x >= picture_.width || y >= picture_.height) continue;
                    covered += matte.row(y)[x] >= 128 ? 1 : 0;
                    any_cut = any_cut || cut.row(y)[x] != 0;
                }
            }
            if (2 * covered >= all) unknowns_[index(i, j)] = inside_++;
            cut_[index(i, j)] = any_cut;
        }
    }
}

Edge Grid::edge(int i, int j, int di, int dj) const {
    const int x = i + di, y = j + dj;
    if (unknown(x, y) >= 0) return Edge::kInside;
    if (cut_[index(i, j)]) return Edge::kCut;
    const bool in_grid = x >= 0 && y >= 0 && x < size_.width && y < size_.height;
    if (in_grid) return cut_[index(x, y)] ? Edge::kCut : Edge::kTurns;
    // Beyond the box: beyond the picture as well?
    const bool beyond = (di < 0 && box_.x0 == 0) || (dj < 0 && box_.y0 == 0) ||
                        (di > 0 && box_.x1 == picture_.width) ||
                        (dj > 0 && box_.y1 == picture_.height);
    return beyond ? Edge::kCut : Edge::kTurns;
}

constexpr std::pair<int, int> kSides[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};

// u at every unknown, in squares of nodes. The outline lies half a step beyond the last node. Empty
// where nothing turns away: then u has no bound.
std::optional<Eigen::VectorXd> solve(const Grid& grid) {
    std::vector<Eigen::Triplet<double>> entries;
    bool turns = false;
    for (int j = 0; j < grid.size().height; ++j) {
        for (int i = 0; i < grid.size().width; ++i) {
            const int k = grid.unknown(i, j);
            if (k < 0) continue;
            double sum = 1e-9;  // holds a part that is cut off all around
            for (const auto& [di, dj] : kSides) {
                const Edge edge = grid.edge(i, j, di, dj);
                sum += edge == Edge::kInside ? 1 : edge == Edge::kTurns ? 2 : 0;
                turns = turns || edge == Edge::kTurns;
                if (const int other = grid.unknown(i + di, j + dj); other >= 0 && other < k)
                    entries.emplace_back(k, other, -1);
            }
            entries.emplace_back(k, k, sum);
        }
    }
    if (!turns) return std::nullopt;
    Eigen::SparseMatrix<double> matrix(grid.inside(), grid.inside());
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::AMDOrdering<int>>
        solver(matrix);
    if (solver.info() != Eigen::Success) return std::nullopt;
    return solver.solve(Eigen::VectorXd::Constant(grid.inside(), 4));
}

// Values at the nodes, continued across the outline.
class OnGrid {
  public:
    OnGrid(const Grid& grid, const Eigen::VectorXd& values) : grid_(grid), values_(values) {}

    [[nodiscard]] double at(int i, int j) const { return values_[grid_.unknown(i, j)]; }
    // Of the neighbour of a node inside: mirrored at a cut, and as much below 0 where the surface
    // turns away.
    [[nodiscard]] double beside(int i, int j, int di, int dj) const {
        switch (grid_.edge(i, j, di, dj)) {
            case Edge::kInside:
                return at(i + di, j + dj);
            case Edge::kTurns:
                return -at(i, j);
            case Edge::kCut:
                break;
        }
        return at(i, j);
    }

  private:
    const Grid& grid_;
    const Eigen::VectorXd& values_;
};

template <typename Each>
void for_inside(const Grid& grid, const Each& each) {
    for (int j = 0; j < grid.size().height; ++j)
        for (int i = 0; i < grid.size().width; ++i)
            if (grid.unknown(i, j) >= 0) each(i, j, grid.unknown(i, j));
}

// Whether a node's eight neighbours are inside.
bool is_deep(const Grid& grid, int i, int j) {
    for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di)
            if (grid.unknown(i + di, j + dj) < 0) return false;
    return true;
}

// k: the larger eigenvalue of −½ of the Hessian, whose trace is 2, smoothed. Beside the outline
// second differences mean little; there it continues.
Eigen::VectorXd curvature(const Grid& grid, const Eigen::VectorXd& u) {
    const OnGrid on(grid, u);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(u.size()), weight = sum;
    for_inside(grid, [&](int i, int j, int k) {
        if (!is_deep(grid, i, j)) return;
        const auto second = [&](int di, int dj) {
            return on.at(i + di, j + dj) + on.at(i - di, j - dj) - 2 * on.at(i, j);
        };
        const double half = -0.25 * (second(1, 0) - second(0, 1));
        const double across = -0.125 * (on.at(i + 1, j + 1) + on.at(i - 1, j - 1) -
                                        on.at(i + 1, j - 1) - on.at(i - 1, j + 1));
        sum[k] = std::clamp(1 + std::sqrt(half * half + across * across), 1.0, 2.0);
        weight[k] = 1;
    });
    for (int round = 0; round < kSmoothings; ++round) {
        const Eigen::VectorXd sum_before = sum, weight_before = weight;
        for_inside(grid, [&](int i, int j, int k) {
            double count = 1;
            for (const auto& [di, dj] : kSides) {
                const int other = grid.unknown(i + di, j + dj);
                if (other < 0) continue;
                sum[k] += sum_before[other];
                weight[k] += weight_before[other];
                ++count;
            }
            sum[k] /= count;
            weight[k] /= count;
        });
    }
    // A disc's where nothing is deep.
    constexpr double kNothing = 1e-9;
    return (sum.array() + kNothing) / (weight.array() + kNothing);
}

// A slope, at most kMostSlope: what is seen more grazingly is a guess that would only be squeezed.
glm::dvec2 bounded_slope(glm::dvec2 slope) {
    const double square = (slope.x * slope.x + slope.y * slope.y) / (kMostSlope * kMostSlope);
    return slope / std::sqrt(1 + square);
}

// Of a surface whose height over the picture plane, in pixels, has these slopes.
Metric metric_of_height(double height, glm::dvec2 slope, const glm::dvec3& ray, double focal_px) {
    const double z = focal_px - std::min(height, kMostHeight * focal_px);
    const glm::dvec3 x = glm::dvec3(z / focal_px, 0, 0) - ray * slope.x;
    const glm::dvec3 y = glm::dvec3(0, z / focal_px, 0) - ray * slope.y;
    return {glm::dot(x, x), glm::dot(x, y), glm::dot(y, y)};
}

}  // namespace

bool add_inflated(MetricField& field, ViewU8x1 matte, ViewU8x1 cut, ViewU8x1 seen,
                  const ViewCamera& camera, double roundness) {
    const Grid grid(matte, cut);
    if (grid.inside() < kLeastNodes) return false;
    const auto u = solve(grid);
    if (!u) return false;
    // Squares of heights at the nodes, px².
    const double unit = roundness * grid.step();
    const Eigen::VectorXd squares = unit * unit * u->cwiseQuotient(curvature(grid, *u));
    const OnGrid on(grid, squares);
    for_inside(grid, [&](int i, int j, int k) {
        const Vec2 at = grid.place(i, j);
        const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
        if (x >= seen.width() || y >= seen.height() || seen.row(y)[x] < 128) return;
        const double height = std::sqrt(std::max(squares[k], 1e-6));
        // d√s = ds / (2 √s)
        const double by = 1 / (4.0 * grid.step() * height);
        const glm::dvec2 slope =
            bounded_slope({by * (on.beside(i, j, 1, 0) - on.beside(i, j, -1, 0)),
                           by * (on.beside(i, j, 0, 1) - on.beside(i, j, 0, -1))});
        const Metric metric = metric_of_height(height, slope, camera.ray(at), camera.focal_px);
        const double cosine = facing(metric);
        if (cosine > 0) field.add(at, metric, cosine * cosine);
    });
    return true;
}

}  // namespace weft

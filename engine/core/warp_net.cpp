#include "engine/core/warp_net.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace weft {
namespace {

using glm::dvec2;

// A grid folds where it leaves less than this of an area: none is the fold itself, and near it the
// way back has no accuracy.
constexpr double kLeastArea = 0.02;
constexpr int kSamples = 8;  // for each patch, along both axes

glm::dmat3 rest_map(const Quad<double>& corners, int columns, int rows) {
    const glm::dmat3 shrink(1.0 / columns, 0, 0, 0, 1.0 / rows, 0, 0, 0, 1);
    return square_to_quad<double>(corners) * shrink;
}

struct OnSegment {
    dvec2 nearest;
    double squared = 0;
};

OnSegment nearest_on(dvec2 a, dvec2 b, dvec2 p) {
    const dvec2 along = b - a;
    const double t = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0, 1.0);
    const dvec2 nearest = a + t * along;
    return {nearest, glm::dot(p - nearest, p - nearest)};
}

OnSegment nearest_on_border(const Quad<double>& corners, dvec2 p) {
    OnSegment best = nearest_on(corners[0], corners[1], p);
    for (std::size_t k = 1; k < 4; ++k) {
        const OnSegment side = nearest_on(corners[k], corners[(k + 1) % 4], p);
        if (side.squared < best.squared) best = side;
    }
    return best;
}

double determinant(const glm::dmat2& m) {
    return m[0].x * m[1].y - m[1].x * m[0].y;
}

// How far from a to b, elements linear in between, the determinant stays at least kLeastArea.
double share_with_area(const glm::dmat2& a, const glm::dmat2& b) {
    const double from = determinant(a), to = determinant(b);
    if (from < kLeastArea) return 0;
    // det(a + t (b − a)) = from + t linear + t² square
    const double square = determinant(b - a), linear = to - from - square;
    const double c = from - kLeastArea;
    const double under = linear * linear - 4 * square * c;
    if (under <= 0) return 1;
    // Of the two roots the smallest above 0, computed without cancellation.
    const double q = -0.5 * (linear + (linear < 0 ? -std::sqrt(under) : std::sqrt(under)));
    double share = 1;
    for (const double root : {square != 0 ? q / square : 2.0, q != 0 ? c / q : 2.0})
        if (root >= 0 && root < share) share = root;
    return share;
}

}  // namespace

WarpNet::WarpNet(const GridWarp& warp, const std::vector<WarpPoint>& points)
    : columns_(warp.columns),
      rows_(warp.rows),
      corners_(warp.corners),
      falloff_px_(warp.falloff_px),
      rest_from_grid_(rest_map(warp.corners, warp.columns, warp.rows)),
      grid_from_rest_(glm::inverse(rest_from_grid_)),
      controls_(static_cast<std::size_t>(3 * columns_ + 1) *
                static_cast<std::size_t>(3 * rows_ + 1)) {
    place_controls(points);
}

dvec2 WarpNet::rest(dvec2 grid) const {
    const glm::dvec3 p = rest_from_grid_ * glm::dvec3(grid, 1);
    return dvec2(p.x, p.y) / p.z;
}

// Control points are displacements, so that a grid at rest moves nothing in any perspective. The
// twist, the mixed derivative, is that of the points' tensor product.
void WarpNet::place_controls(const std::vector<WarpPoint>& points) {
    const auto index = [&](int i, int j) {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_ + 1) +
               static_cast<std::size_t>(i);
    };
    std::vector<dvec2> d(points.size());
    for (int j = 0; j <= rows_; ++j)
        for (int i = 0; i <= columns_; ++i)
            d[index(i, j)] = points[index(i, j)].at - rest(dvec2(i, j));
    // Slopes per patch: central between two neighbours, one-sided at the border.
    const auto by_column = [&](int i, int j) {
        const int a = std::max(i - 1, 0), b = std::min(i + 1, columns_);
        return (d[index(b, j)] - d[index(a, j)]) / static_cast<double>(b - a);
    };
    const auto by_row = [&](int i, int j) {
        const int a = std::max(j - 1, 0), b = std::min(j + 1, rows_);
        return (d[index(i, b)] - d[index(i, a)]) / static_cast<double>(b - a);
    };
    const auto twist = [&](int i, int j) {
        const int a = std::max(j - 1, 0), b = std::min(j + 1, rows_);
        return (by_column(i, b) - by_column(i, a)) / static_cast<double>(b - a) / 9.0;
    };
    for (int j = 0; j <= rows_; ++j) {
        for (int i = 0; i <= columns_; ++i) {
            const WarpPoint& point = points[index(i, j)];
            const glm::dvec3 p = rest_from_grid_ * glm::dvec3(i, j, 1);
            const dvec2 at = dvec2(p.x, p.y) / p.z;
            const auto at_rest = [&](const glm::dvec3& axis) {
                return (dvec2(axis.x, axis.y) - at * axis.z) / p.z / 3.0;
            };
            const dvec2 across = at_rest(rest_from_grid_[0]), along = at_rest(rest_from_grid_[1]);
            const dvec2 u = by_column(i, j) / 3.0, v = by_row(i, j) / 3.0, t = twist(i, j);
            const dvec2 right = point.right ? *point.right - across : u;
            const dvec2 left = point.left ? *point.left + across : -u;
            const dvec2 down = point.down ? *point.down - along : v;
            const dvec2 up = point.up ? *point.up + along : -v;
            for (int dj = -1; dj <= 1; ++dj) {
                for (int di = -1; di <= 1; ++di) {
                    const int ci = 3 * i + di, cj = 3 * j + dj;
                    if (ci < 0 || cj < 0 || ci > 3 * columns_ || cj > 3 * rows_) continue;
                    const dvec2 aside = di == 0 ? dvec2(0, 0) : di > 0 ? right : left;
                    const dvec2 below = dj == 0 ? dvec2(0, 0) : dj > 0 ? down : up;
                    control(ci, cj) =
                        d[index(i, j)] + aside + below + static_cast<double>(di * dj) * t;
                }
            }
        }
    }
}

// Bernstein's polynomials inside. Beyond the border the patch goes on along its slope there, ever
// less: x / (1 + x / r) after x patches, r a quarter of the grid's, so that it is differentiable
// and bounded, however finely the grid is divided.
WarpNet::Weights WarpNet::weights(double along, int patches) {
    Weights out;
    const int cell = along >= patches ? patches - 1 : along > 0 ? static_cast<int>(along) : 0;
    out.first = 3 * cell;
    const double t = along - cell;
    if (t >= 0 && t <= 1) {
        const double s = 1 - t;
        out.at = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
        out.slope = {-3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t};
        return out;
    }
    const double x = t < 0 ? -t : t - 1, reach = 0.25 * patches;
    const double rest = 1 / (1 + x / reach), gone = reach * (1 - rest), slope = 3 * rest * rest;
    if (t < 0) {
        out.at = {1 + 3 * gone, -3 * gone, 0, 0};
        out.slope = {-slope, slope, 0, 0};
    } else {
        out.at = {0, 0, -3 * gone, 1 + 3 * gone};
        out.slope = {0, 0, -slope, slope};
    }
    return out;
}

WarpNet::Sum WarpNet::displacement(const Weights& u, const Weights& v) const {
    Sum out;
    for (std::size_t j = 0; j < 4; ++j) {
        const dvec2* row = &controls_[(static_cast<std::size_t>(v.first) + j) *
                                          static_cast<std::size_t>(3 * columns_ + 1) +
                                      static_cast<std::size_t>(u.first)];
        dvec2 at(0, 0), slope(0, 0);
        for (std::size_t i = 0; i < 4; ++i) {
            at += u.at[i] * row[i];
            slope += u.slope[i] * row[i];
        }
        out.at += v.at[j] * at;
        out.by_column += v.at[j] * slope;
        out.by_row += v.slope[j] * at;
    }
    return out;
}

WarpNet::Sum WarpNet::displacement(dvec2 grid) const {
    return displacement(weights(grid.x, columns_), weights(grid.y, rows_));
}

WarpNet::OnGrid WarpNet::on_grid(dvec2 grid) const {
    const glm::dvec3 p = rest_from_grid_ * glm::dvec3(grid, 1);
    const dvec2 at = dvec2(p.x, p.y) / p.z;
    const auto by = [&](const glm::dvec3& axis) {
        return (dvec2(axis.x, axis.y) - at * axis.z) / p.z;
    };
    const Sum moved = displacement(grid);
    return {at + moved.at, by(rest_from_grid_[0]) + moved.by_column,
            by(rest_from_grid_[1]) + moved.by_row};
}

WarpNet::Place WarpNet::moved(dvec2 rest) const {
    const glm::dvec3 p = grid_from_rest_ * glm::dvec3(rest, 1);
    // The third coordinate has one sign on this side of the horizon of the grid's perspective; what
    // lies beyond continues what is at its end.
    const double side = grid_from_rest_[2].z + grid_from_rest_[0].z * corners_[0].x +
                        grid_from_rest_[1].z * corners_[0].y;
    const double z = side < 0 ? -p.z : p.z, sign = side < 0 ? -1 : 1;
    constexpr double kHorizon = 1e-9;
    const double depth = std::max(z, kHorizon * std::abs(side));
    const dvec2 grid = sign * dvec2(p.x, p.y) / depth;
    const Weights wu = weights(grid.x, columns_), wv = weights(grid.y, rows_);
    const Sum d = displacement(wu, wv);
    glm::dmat2 slopes(0);
    for (int axis = 0; axis < 2; ++axis) {
        const glm::dvec3 step = sign * grid_from_rest_[axis];
        const dvec2 by =
            z > depth * 0.5 ? (dvec2(step.x, step.y) - grid * step.z) / depth : dvec2(0, 0);
        slopes[axis] = d.by_column * by.x + d.by_row * by.y;
    }
    const bool inside =
        z > 0 && grid.x >= 0 && grid.y >= 0 && grid.x <= columns_ && grid.y <= rows_;
    if (falloff_px_ <= 0 || inside) return {rest + d.at, glm::dmat2(1) + slopes};
    const OnSegment border = nearest_on_border(corners_, rest);
    const double distance = std::sqrt(border.squared), x = distance / falloff_px_;
    if (x >= 1) return {rest, glm::dmat2(1)};
    const double share = 1 - x * x * (3 - 2 * x);
    Place out{rest + share * d.at, glm::dmat2(1) + share * slopes};
    if (distance > 0) {
        const dvec2 away = (rest - border.nearest) / distance;
        const dvec2 fade = -6 * x * (1 - x) / falloff_px_ * away;
        out.jacobian[0] += d.at * fade.x;
        out.jacobian[1] += d.at * fade.y;
    }
    return out;
}

// Places at rest that show every patch closely, and what is beyond the border, each with its place
// on the grid.
std::vector<std::pair<dvec2, dvec2>> WarpNet::samples() const {
    std::vector<std::pair<dvec2, dvec2>> out;
    const int across = kSamples * columns_, down = kSamples * rows_;
    for (int j = 0; j <= down; ++j) {
        for (int i = 0; i <= across; ++i) {
            const dvec2 grid(static_cast<double>(i) / kSamples, static_cast<double>(j) / kSamples);
            out.emplace_back(rest(grid), grid);
        }
    }
    std::vector<double> reaches;
    if (falloff_px_ > 0) {
        for (int k = 1; k <= kSamples; ++k)
            reaches.push_back(falloff_px_ * k / kSamples);
    } else {
        const double side = std::max(glm::distance(corners_[1], corners_[0]),
                                     glm::distance(corners_[3], corners_[0]));
        constexpr int kHalvings = 8;
        for (int k = 0; k < kHalvings; ++k)
            reaches.push_back(std::ldexp(2 * side, -k));
    }
    const dvec2 middle = 0.25 * (corners_[0] + corners_[1] + corners_[2] + corners_[3]);
    const auto beyond = [&](dvec2 grid, dvec2 away) {
        for (const double reach : reaches)
            out.emplace_back(rest(grid) + reach * away, grid);
    };
    const auto side = [&](dvec2 from, dvec2 to, int steps) {
        const dvec2 a = rest(from), b = rest(to), along = glm::normalize(b - a);
        dvec2 away(along.y, -along.x);
        if (glm::dot(away, a - middle) < 0) away = -away;
        for (int k = 0; k <= steps; ++k)
            beyond(from + (to - from) * (static_cast<double>(k) / steps), away);
        beyond(from, glm::normalize(away - along));
    };
    const dvec2 c(columns_, 0), r(0, rows_);
    side({0, 0}, c, across);
    side(c, c + r, down);
    side(c + r, r, across);
    side(r, {0, 0}, down);
    return out;
}

WarpNet::Box WarpNet::reach() const {
    Box out{dvec2(1e9), dvec2(-1e9)};
    for (int j = 0; j <= kSamples * rows_; ++j) {
        for (int i = 0; i <= kSamples * columns_; ++i) {
            const dvec2 at =
                on_grid({static_cast<double>(i) / kSamples, static_cast<double>(j) / kSamples}).at;
            out.low = glm::min(out.low, at);
            out.high = glm::max(out.high, at);
        }
    }
    // Without a fall-off most of what continues lies within the quarter of the grid's size over
    // which it does.
    const dvec2 margin =
        falloff_px_ > 0 ? dvec2(falloff_px_, falloff_px_) : 0.25 * (out.high - out.low);
    return {out.low - margin, out.high + margin};
}

WarpNet::Unfolded WarpNet::unfolded_towards(const WarpNet& to) const {
    Unfolded out;
    for (const auto& [rest, grid] : samples()) {
        const double share = share_with_area(moved(rest).jacobian, to.moved(rest).jacobian);
        if (share < out.share) out = {share, grid};
    }
    return out;
}

}  // namespace weft

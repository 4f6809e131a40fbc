#include "engine/form/position_metric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "engine/core/geometry.h"
#include "engine/form/pulled_back.h"

namespace weft {
namespace {

constexpr int kReach = 2;           // px; the side of a fitted window is 2 · kReach + 1
constexpr int kOfCell = 4;          // places measured along the side of a cell
constexpr double kMostBent = 0.35;  // of a window's own extent that may lie off its plane

using Place = std::array<double, 3>;

double dot(const Place& a, const Place& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The slopes of the place over x and y by least squares; the window is symmetric, so that the two
// are told apart by sums of their own. Empty where the window leaves the surface or is folded.
std::optional<Metric> metric_at(ViewF3 positions, ViewU8x1 matte, int x, int y) {
    Place along_x{}, along_y{}, mean{};
    double squares = 0, count = 0;
    for (int v = -kReach; v <= kReach; ++v) {
        for (int u = -kReach; u <= kReach; ++u) {
            if (matte.row(y + v)[x + u] != 255) return std::nullopt;
            const float* p = positions.pixel(x + u, y + v);
            if (!std::isfinite(p[0] + p[1] + p[2])) return std::nullopt;
            for (std::size_t c = 0; c < 3; ++c) {
                const double place = p[c];
                along_x[c] += u * place, along_y[c] += v * place, mean[c] += place;
            }
            squares += u * u, ++count;
        }
    }
    for (std::size_t c = 0; c < 3; ++c)
        along_x[c] /= squares, along_y[c] /= squares, mean[c] /= count;
    double off = 0, extent = 0;
    for (int v = -kReach; v <= kReach; ++v) {
        for (int u = -kReach; u <= kReach; ++u) {
            const float* p = positions.pixel(x + u, y + v);
            for (std::size_t c = 0; c < 3; ++c) {
                const double step = u * along_x[c] + v * along_y[c];
                const double left = p[c] - mean[c] - step;
                off += left * left, extent += step * step;
            }
        }
    }
    if (!(extent > 0) || off > kMostBent * kMostBent * extent) return std::nullopt;
    const Metric out{dot(along_x, along_x), dot(along_x, along_y), dot(along_y, along_y)};
    if (!(out.determinant() > 0)) return std::nullopt;
    return out;
}

}  // namespace

void add_positions(MetricField& field, ViewF3 positions, ViewU8x1 matte,
                   const LatticeField& ref_from_cur, double weight) {
    const int step = std::max(1, field.spacing() / kOfCell);
    for (int y = kReach; y < positions.height() - kReach; y += step) {
        for (int x = kReach; x < positions.width() - kReach; x += step) {
            if (matte.row(y)[x] != 255) continue;
            const auto metric = metric_at(positions, matte, x, y);
            if (!metric) continue;
            const double cosine = facing(*metric);
            if (!(cosine > 0)) continue;
            const Vec2 at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            if (const auto seen = pulled_back(*metric, ref_from_cur, at))
                field.add(at + ref_from_cur.at(at), *seen, weight * cosine * cosine);
        }
    }
}

}  // namespace weft

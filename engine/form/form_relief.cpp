#include "engine/form/form_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/form/exact_math.h"

namespace weft {
namespace {

constexpr double kCommonTangent = 0.91;  // of half the field of view's, twice: 49°
constexpr double kLeastViewTangent = 0.25, kMostViewTangent = 2.6;
constexpr double kOff = 0.1;  // ln of the larger length, at which a cell hardly counts

// Of the directions of rays, as seen from the camera.
Metric of_directions(const glm::dvec3& ray, double focal_px) {
    const double n = ray.x * ray.x + ray.y * ray.y + 1, by = 1 / (focal_px * focal_px * n);
    return {by * (1 - ray.x * ray.x / n), by * (-ray.x * ray.y / n), by * (1 - ray.y * ray.y / n)};
}

double log_depth(const Metric& g, const glm::dvec3& ray, double focal_px) {
    const Metric a = of_directions(ray, focal_px);
    const double area = a.determinant();
    const double half = 0.5 * (a.yy * g.xx - 2 * a.xy * g.xy + a.xx * g.yy) / area;
    const double product = g.determinant() / area;
    const double smaller = product / (half + std::sqrt(std::max(0.0, half * half - product)));
    const double n = ray.x * ray.x + ray.y * ray.y + 1;
    return 0.5 * (ln(std::max(smaller, 1e-300)) - ln(n));
}

// Of all cells, or of those with evidence; 0 elsewhere.
std::vector<double> log_depths(const MetricField& field, const ViewCamera& camera, bool all) {
    std::vector<double> out;
    for (int j = 0; j < field.cells().height; ++j) {
        for (int i = 0; i < field.cells().width; ++i) {
            const bool counts = all || field.evidence(i, j) > 0;
            out.push_back(counts ? log_depth(field.at(i, j), camera.ray(field.centre_of(i, j)),
                                             camera.focal_px)
                                 : 0.0);
        }
    }
    return out;
}

// How far the larger lengths by the slopes of the depths are off those of the metric: the mean of
// bounded squares.
double disagreement(const MetricField& field, const ViewCamera& camera) {
    const std::vector<double> depth = log_depths(field, camera, false);
    const auto at = [&](int i, int j) {
        return depth[static_cast<std::size_t>(j) * static_cast<std::size_t>(field.cells().width) +
                     static_cast<std::size_t>(i)];
    };
    const auto seen = [&](int i, int j) { return field.evidence(i, j) > 0; };
    double sum = 0, count = 0;
    for (int j = 1; j + 1 < field.cells().height; ++j) {
        for (int i = 1; i + 1 < field.cells().width; ++i) {
            if (!seen(i, j) || !seen(i - 1, j) || !seen(i + 1, j) || !seen(i, j - 1) ||
                !seen(i, j + 1))
                continue;
            const double by = 1 / (2.0 * field.spacing());
            const glm::dvec3 ray = camera.ray(field.centre_of(i, j));
            const glm::dvec3 x =
                ray * (by * (at(i + 1, j) - at(i - 1, j))) + glm::dvec3(1 / camera.focal_px, 0, 0);
            const glm::dvec3 y =
                ray * (by * (at(i, j + 1) - at(i, j - 1))) + glm::dvec3(0, 1 / camera.focal_px, 0);
            const auto dot = [](const glm::dvec3& a, const glm::dvec3& b) {
                return a.x * b.x + a.y * b.y + a.z * b.z;
            };
            const double area = dot(x, x) * dot(y, y) - dot(x, y) * dot(x, y);
            const double off =
                0.5 * (ln(std::max(area, 1e-300)) - ln(field.at(i, j).determinant())) +
                2 * at(i, j);
            sum += off * off / (off * off + kOff * kOff), ++count;
        }
    }
    return count > 0 ? sum / count : std::numeric_limits<double>::infinity();
}

// Continues the depth of what is known by a few nodes, along its slopes: between nodes it is a
// surface through sixteen of them, and beyond the evidence the metric tells no depth.
void continue_slopes(LatticeField& relief) {
    constexpr int kRings = 3;
    const int width = relief.nodes().width(), height = relief.nodes().height();
    const auto index = [width](int i, int j) {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(i);
    };
    std::vector<bool> known(index(0, height));
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i)
            known[index(i, j)] = relief.node(i, j).y > 0;
    for (int ring = 0; ring < kRings; ++ring) {
        const std::vector<bool> before = known;
        const auto knows = [&](int i, int j) {
            return i >= 0 && j >= 0 && i < width && j < height && before[index(i, j)];
        };
        for (int j = 0; j < height; ++j) {
            for (int i = 0; i < width; ++i) {
                if (before[index(i, j)]) continue;
                float sum = 0, count = 0;
                for (const auto& [di, dj] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
                    if (!knows(i + di, j + dj)) continue;
                    const float near = relief.node(i + di, j + dj).x;
                    const float far = knows(i + 2 * di, j + 2 * dj)
                                          ? relief.node(i + 2 * di, j + 2 * dj).x
                                          : near;
                    sum += 2 * near - far;
                    ++count;
                }
                if (!(count > 0)) continue;
                relief.set_node(i, j, {sum / count, 0});
                known[index(i, j)] = true;
            }
        }
    }
}

ViewCamera camera_of(double tangent, Size picture) {
    const double side = std::max(picture.width, picture.height);
    return {side / tangent,
            0.5f * Vec2(static_cast<float>(picture.width), static_cast<float>(picture.height))};
}

}  // namespace

LatticeField relief_from_metric(const MetricField& field, const ViewCamera& camera,
                                bool known_beyond) {
    const std::vector<double> depth = log_depths(field, camera, true);
    const double unit = 0.5 * ln(field.scaled_by());
    LatticeField out(field.domain().size(), field.spacing());
    const Size cells = field.cells();
    for (int j = 0; j < out.nodes().height(); ++j) {
        for (int i = 0; i < out.nodes().width(); ++i) {
            // Of the cells around the node, those with evidence.
            std::array<double, 2> sum{}, count{};
            for (const int y : {j - 1, j}) {
                for (const int x : {i - 1, i}) {
                    if (x < 0 || y < 0 || x >= cells.width || y >= cells.height) continue;
                    const std::size_t known = field.evidence(x, y) > 0 ? 1 : 0;
                    sum[known] +=
                        depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(cells.width) +
                              static_cast<std::size_t>(x)];
                    ++count[known];
                }
            }
            const bool known = count[1] > 0;
            const double mean = known ? sum[1] / count[1] : sum[0] / count[0];
            out.set_node(i, j,
                         {static_cast<float>(mean - unit), known || known_beyond ? 1.0f : 0.0f});
        }
    }
    if (!known_beyond) continue_slopes(out);
    return out;
}

void add_relief(FormMap& form, const MetricField& field, double fov_deg, Size picture,
                bool known_beyond) {
    form.relief = relief_from_metric(field, camera_with(fov_deg, picture), known_beyond);
    form.relief_fov_deg = static_cast<float>(fov_deg);
}

double fov_of_metric(const MetricField& field, Size picture) {
    double best = kCommonTangent;
    double least = disagreement(field, camera_of(best, picture));
    const double step = std::sqrt(std::sqrt(std::sqrt(kMostViewTangent / kLeastViewTangent)));
    double from = kLeastViewTangent, to = kMostViewTangent;
    // Eight steps over all, then over what is left around the best.
    for (int round = 0; round < 4; ++round) {
        const double ratio = round == 0 ? step : std::sqrt(std::sqrt(std::sqrt(to / from)));
        for (double tangent = from; tangent <= to * 1.0001; tangent *= ratio) {
            const double now = disagreement(field, camera_of(tangent, picture));
            if (now < least) least = now, best = tangent;
        }
        from = best / ratio, to = best * ratio;
    }
    const long double half = 0.5L * static_cast<long double>(best) * picture.width /
                             std::max(picture.width, picture.height);
    return static_cast<double>(2 * std::atan(half) * 180 / std::numbers::pi_v<long double>);
}

}  // namespace weft

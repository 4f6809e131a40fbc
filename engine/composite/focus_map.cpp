#include "engine/composite/focus_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "engine/core/blur_inside.h"
#include "engine/core/linear_system.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

// Of the fit along depth.
constexpr std::size_t kDepthBins = 12, kFewestInBin = 40;
// Of the range of nearness, within 2 px: an edge between two objects.
constexpr float kStep = 0.05f;
// Of the fit over the picture.
constexpr int kTile_px = 64;
constexpr std::size_t kFewestTiles = 6, kFewestInTile = 24;
constexpr double kLeastSlope_px = 0.5;   // from one end of the region to the other
constexpr double kSlopeOfResidue = 3.0;  // times the residual of the plane
constexpr double kGradual = 0.25;        // of each, to either side: half and all of the agreement

struct Sample {
    double u, v, variance, weight;
};

// Least squares of `terms` columns by elimination; the ridge keeps it solvable. Terms of two
// variables: 1, u, v, or 1, u, u².
template <std::size_t N, class Terms>
std::array<double, N> least_squares(const std::vector<Sample>& samples, const Terms& terms) {
    LinearSystem<N> m{};
    for (const Sample& s : samples) {
        const std::array<double, N> t = terms(s);
        for (std::size_t i = 0; i < N; ++i) {
            for (std::size_t j = 0; j < N; ++j)
                m[i][j] += s.weight * t[i] * t[j];
            m[i][N] += s.weight * t[i] * s.variance;
        }
    }
    for (std::size_t i = 0; i < N; ++i)
        m[i][i] += 1e-9 * (1 + m[i][i]);
    return solve(m);
}

// Relative errors count: a tenth of a pixel matters on a sharp edge and not on a soft one.
double weight_of(double blur) {
    return 1.0 / (0.05 + blur * blur * blur * blur);
}

struct Range {
    float low, high;
};

Range around(const ImageF1& plane, int x, int y) {
    Range r{plane.row(y)[x], plane.row(y)[x]};
    for (int v = std::max(0, y - 2); v <= std::min(plane.height() - 1, y + 2); ++v) {
        for (int u = std::max(0, x - 2); u <= std::min(plane.width() - 1, x + 2); ++u) {
            const float n = plane.row(v)[u];
            if (!std::isfinite(n)) return {0, std::numeric_limits<float>::infinity()};
            r.low = std::min(r.low, n), r.high = std::max(r.high, n);
        }
    }
    return r;
}

}  // namespace

float FocusModel::blur_px(float nearness) const {
    if (!std::isfinite(nearness)) nearness = lowest;
    const float u = std::clamp(nearness, lowest, highest) - middle;
    const float variance = constant + u * (linear + u * square);
    return std::clamp(std::sqrt(std::max(0.0f, variance)), kSharpestEdge_px, kSoftestEdge_px);
}

std::optional<FocusModel> fit_focus(const std::vector<EdgeBlur>& edges, const ImageF1& nearness) {
    struct Placed {
        float nearness;
        EdgeBlur edge;
    };
    std::vector<Placed> placed;
    float lowest = std::numeric_limits<float>::max(), highest = -lowest;
    for (const EdgeBlur& e : edges) {
        const float n = nearness.row(e.y)[e.x];
        if (!std::isfinite(n)) continue;
        lowest = std::min(lowest, n), highest = std::max(highest, n);
        placed.push_back({n, e});
    }
    if (placed.size() < 2 * kFewestInBin || !(highest > lowest)) return std::nullopt;
    const float step = kStep * (highest - lowest);
    std::erase_if(placed, [&](const Placed& p) {
        const Range r = around(nearness, p.edge.x, p.edge.y);
        return r.high - r.low > step;
    });
    const std::size_t bins = std::min(kDepthBins, placed.size() / kFewestInBin);
    if (bins < 2) return std::nullopt;
    std::stable_sort(placed.begin(), placed.end(),
                     [](const Placed& a, const Placed& b) { return a.nearness < b.nearness; });
    std::vector<Sample> samples;
    for (std::size_t b = 0; b < bins; ++b) {
        std::vector<EdgeBlur> here;
        double mean = 0;
        for (std::size_t k = b * placed.size() / bins; k < (b + 1) * placed.size() / bins; ++k) {
            here.push_back(placed[k].edge);
            mean += static_cast<double>(placed[k].nearness);
        }
        mean /= static_cast<double>(here.size());
        const double blur = static_cast<double>(sharper_blur_px(std::move(here)));
        samples.push_back({mean, 0, blur * blur, weight_of(blur)});
    }
    FocusModel model;
    model.lowest = static_cast<float>(samples.front().u);
    model.highest = static_cast<float>(samples.back().u);
    if (!(model.highest > model.lowest)) return std::nullopt;
    model.middle = 0.5f * (model.lowest + model.highest);
    const double scale = 0.5 * static_cast<double>(model.highest - model.lowest);
    for (Sample& s : samples)
        s.u = (s.u - static_cast<double>(model.middle)) / scale;
    std::array<double, 3> c{};
    if (samples.size() > 2) {
        c = least_squares<3>(samples, [](const Sample& s) {
            return std::array{1.0, s.u, s.u * s.u};
        });
    }
    // A lens never sharpens away from its focus.
    if (!(c[2] > 0)) {
        const auto line = least_squares<2>(samples, [](const Sample& s) {
            return std::array{1.0, s.u};
        });
        c = {line[0], line[1], 0};
    }
    model.constant = static_cast<float>(c[0]);
    model.linear = static_cast<float>(c[1] / scale);
    model.square = static_cast<float>(c[2] / (scale * scale));
    return model;
}

float BlurSlope::variance(float x, float y) const {
    return std::clamp(constant + by_x * x + by_y * y, least_px * least_px, most_px * most_px);
}

BlurSlope blur_slope(const std::vector<EdgeBlur>& edges, Size size) {
    const int columns = (size.width + kTile_px - 1) / kTile_px;
    const int rows = (size.height + kTile_px - 1) / kTile_px;
    std::vector<std::vector<EdgeBlur>> tiles(static_cast<std::size_t>(columns) *
                                             static_cast<std::size_t>(rows));
    for (const EdgeBlur& e : edges) {
        const int tile = (e.y / kTile_px) * columns + e.x / kTile_px;
        tiles[static_cast<std::size_t>(tile)].push_back(e);
    }
    std::vector<Sample> samples;
    for (auto& tile : tiles) {
        if (tile.size() < kFewestInTile) continue;
        double x = 0, y = 0;
        for (const EdgeBlur& e : tile)
            x += e.x, y += e.y;
        const auto n = static_cast<double>(tile.size());
        const double blur = static_cast<double>(sharper_blur_px(std::move(tile)));
        samples.push_back(
            {x / n / size.width - 0.5, y / n / size.height - 0.5, blur * blur, weight_of(blur)});
    }
    if (samples.size() < kFewestTiles) return {};
    const auto c = least_squares<3>(samples, [](const Sample& s) {
        return std::array{1.0, s.u, s.v};
    });
    const auto blur_at = [&](double u, double v) {
        return std::clamp(std::sqrt(std::max(0.0, c[0] + c[1] * u + c[2] * v)),
                          static_cast<double>(kSharpestEdge_px),
                          static_cast<double>(kSoftestEdge_px));
    };
    double least = 1e9, most = 0, residue = 0;
    for (const Sample& s : samples) {
        const double blur = blur_at(s.u, s.v);
        least = std::min(least, blur), most = std::max(most, blur);
        residue += std::abs(blur - std::sqrt(s.variance)) / static_cast<double>(samples.size());
    }
    const auto rises = [](double v, double middle) {
        return std::clamp((v / middle - (1 - kGradual)) / (2 * kGradual), 0.0, 1.0);
    };
    BlurSlope out;
    out.by_x = static_cast<float>(c[1] / size.width);
    out.by_y = static_cast<float>(c[2] / size.height);
    out.constant = static_cast<float>(c[0] - 0.5 * (c[1] + c[2]));
    out.least_px = static_cast<float>(least);
    out.most_px = static_cast<float>(most);
    out.agreement =
        static_cast<float>(rises(most - least, kLeastSlope_px) *
                           rises((most - least) / std::max(residue, 1e-6), kSlopeOfResidue));
    return out;
}

void blur_by_map(ImageView<float, 3> picture, ViewU8x1 matte, const ImageF1& sigma_px) {
    constexpr std::array<float, 10> kLevels{0, 0.4f, 0.7f, 1, 1.4f, 2, 2.8f, 4, 5.6f, 12};
    float most = 0;
    for (int y = 0; y < picture.height(); ++y)
        most =
            std::max(most, *std::max_element(sigma_px.row(y), sigma_px.row(y) + picture.width()));
    ImageF3 sharp(picture.size());
    for (int y = 0; y < picture.height(); ++y)
        std::copy_n(picture.row(y), 3 * picture.width(), sharp.row(y));
    ImageF3 below = sharp;
    for (std::size_t k = 1; k < kLevels.size() && kLevels[k - 1] < most; ++k) {
        const float low = kLevels[k - 1], high = std::min(kLevels[k], std::max(most, 0.2f));
        ImageF3 above = sharp;
        blur_inside(above, matte, high);
        parallel_rows(picture.height(), 16, [&](int y0, int y1) {
            for (int y = y0; y < y1; ++y) {
                for (int x = 0; x < picture.width(); ++x) {
                    const float s = sigma_px.row(y)[x];
                    if (matte.row(y)[x] == 0 || !(s > low) || !(s <= high)) continue;
                    // Variances add, so they are what is mixed.
                    const float t = (s * s - low * low) / (high * high - low * low);
                    for (int c = 0; c < 3; ++c) {
                        const float a = below.pixel(x, y)[c];
                        picture.pixel(x, y)[c] = a + t * (above.pixel(x, y)[c] - a);
                    }
                }
            }
        });
        below = std::move(above);
    }
}

}  // namespace weft

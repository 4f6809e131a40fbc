#include "engine/mask/band_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>
#include <utility>
#include <vector>

namespace weft {
namespace {

// Capacities are integers, so that sums do not depend on their order.
constexpr float kUnits = 64;
constexpr float kMaxLogOdds = 12;
constexpr float kLeastContrast = 0.02f;  // a boundary costs a little even on the strongest edge

struct Step {
    int dx, dy;
    float inverse_length;
};
constexpr std::array<Step, 4> kNeighbourSteps{
    {{1, 0, 1.0f}, {0, 1, 1.0f}, {1, 1, 0.70710678f}, {-1, 1, 0.70710678f}}};

int color_distance(ViewU8x3 frame, int x0, int y0, int x1, int y1) {
    const std::uint8_t* a = frame.pixel(x0, y0);
    const std::uint8_t* b = frame.pixel(x1, y1);
    const int r = a[0] - b[0], g = a[1] - b[1], c = a[2] - b[2];
    return r * r + g * g + c * c;
}

// 1 / (2 mean ‖ΔI‖²) over the band (Rother et al. 2004, eq. 5).
float contrast_scale(ViewU8x3 frame, ViewU8x1 undecided) {
    std::int64_t sum = 0, n = 0;
    for (int y = 0; y + 1 < frame.height(); ++y) {
        for (int x = 0; x + 1 < frame.width(); ++x) {
            if (undecided.row(y)[x] == 0) continue;
            sum += color_distance(frame, x, y, x + 1, y) + color_distance(frame, x, y, x, y + 1);
            n += 2;
        }
    }
    const double mean = n > 0 ? static_cast<double>(sum) / static_cast<double>(n) : 0;
    return static_cast<float>(1 / (2 * std::max(mean, 20.0)));
}

// The pixels to be decided, numbered in scan order (−1: decided by the prior).
struct Band {
    Band(ViewF1 prior_phi, ViewU8x1 undecided)
        : labels(prior_phi.size()), node(prior_phi.size(), -1) {
        for (int y = 0; y < prior_phi.height(); ++y) {
            for (int x = 0; x < prior_phi.width(); ++x) {
                const float phi = prior_phi.row(y)[x];
                labels.row(y)[x] = phi > 0 ? 1 : 0;
                if (undecided.row(y)[x] != 0) node.row(y)[x] = nodes++;
            }
        }
    }
    Image<std::uint8_t, 1> labels;
    Image<std::int32_t, 1> node;
    int nodes = 0;
};

struct Terminal {
    int inside = 0, outside = 0;
};

// Links of one pixel to its later neighbours; a link to a decided pixel becomes evidence.
void link_pixel(cv::detail::GCGraph<int>& graph, std::vector<Terminal>& terminals, const Band& band,
                ViewU8x3 frame, Vec2i at, float beta, float smoothness) {
    const int p = band.node.row(at.y)[at.x];
    for (const Step& s : kNeighbourSteps) {
        const Vec2i to = at + Vec2i(s.dx, s.dy);
        if (to.x < 0 || to.x >= frame.width() || to.y >= frame.height()) continue;
        const int q = band.node.row(to.y)[to.x];
        if (p < 0 && q < 0) continue;
        const float contrast =
            beta * static_cast<float>(color_distance(frame, at.x, at.y, to.x, to.y));
        const float likeness = contrast < 12 ? std::exp(-contrast) : 0.0f;
        const float weight = smoothness * s.inverse_length * (kLeastContrast + likeness);
        const int capacity = 1 + static_cast<int>(std::lround(kUnits * weight));
        if (p >= 0 && q >= 0) {
            graph.addEdges(p, q, capacity, capacity);
            continue;
        }
        const Vec2i decided = p >= 0 ? to : at;
        Terminal& t = terminals[static_cast<std::size_t>(p >= 0 ? p : q)];
        (band.labels.row(decided.y)[decided.x] != 0 ? t.inside : t.outside) += capacity;
    }
}

}  // namespace

Image<std::uint8_t, 1> cut_band(ViewU8x3 frame, ViewF1 log_odds, ViewF1 prior_phi,
                                ViewU8x1 undecided, float smoothness) {
    const int w = frame.width(), h = frame.height();
    Band band(prior_phi, undecided);
    if (band.nodes == 0) return std::move(band.labels);
    const float beta = contrast_scale(frame, undecided);
    const auto nodes = static_cast<unsigned>(band.nodes);
    cv::detail::GCGraph<int> graph(nodes, 8 * nodes);
    for (unsigned i = 0; i < nodes; ++i)
        graph.addVtx();
    std::vector<Terminal> terminals(nodes);
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const int p = band.node.row(y)[x];
            if (p >= 0) {
                const float odds = std::clamp(log_odds.row(y)[x], -kMaxLogOdds, kMaxLogOdds);
                const int units = static_cast<int>(std::lround(odds * kUnits));
                Terminal& t = terminals[static_cast<std::size_t>(p)];
                (units > 0 ? t.inside : t.outside) += std::abs(units);
            }
            link_pixel(graph, terminals, band, frame, Vec2i(x, y), beta, smoothness);
        }
    }
    for (unsigned i = 0; i < nodes; ++i) {
        graph.addTermWeights(static_cast<int>(i), terminals[i].inside, terminals[i].outside);
    }
    graph.maxFlow();
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const int p = band.node.row(y)[x];
            if (p >= 0) band.labels.row(y)[x] = graph.inSourceSegment(p) ? 1 : 0;
        }
    }
    return std::move(band.labels);
}

void remove_islands(Image<std::uint8_t, 1>& labels, ViewF1 prior_phi, float core_px,
                    int max_area_px) {
    const int w = labels.width(), h = labels.height();
    Image<std::uint8_t, 1> seen(labels.size());
    std::vector<Vec2i> part;
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            if (seen.row(y)[x] != 0) continue;
            const std::uint8_t value = labels.row(y)[x];
            bool anchored = false;
            part.assign(1, Vec2i(x, y));
            seen.row(y)[x] = 1;
            for (std::size_t i = 0; i < part.size(); ++i) {
                const Vec2i p = part[i];
                const float phi = prior_phi.row(p.y)[p.x];
                anchored |= value != 0 ? phi >= core_px : phi <= -core_px;
                for (const Vec2i d : {Vec2i(1, 0), Vec2i(-1, 0), Vec2i(0, 1), Vec2i(0, -1)}) {
                    const Vec2i q = p + d;
                    if (q.x < 0 || q.y < 0 || q.x >= w || q.y >= h) continue;
                    if (seen.row(q.y)[q.x] != 0 || labels.row(q.y)[q.x] != value) continue;
                    seen.row(q.y)[q.x] = 1;
                    part.push_back(q);
                }
            }
            if (anchored || static_cast<int>(part.size()) > max_area_px) continue;
            for (const Vec2i p : part) {
                labels.row(p.y)[p.x] = static_cast<std::uint8_t>(value != 0 ? 0 : 1);
            }
        }
    }
}

}  // namespace weft

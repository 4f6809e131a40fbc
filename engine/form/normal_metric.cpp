#include "engine/form/normal_metric.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "engine/form/pulled_back.h"

namespace weft {
namespace {

constexpr double kMostAway = 0.2;            // share of a pass that may face away
constexpr double kLeastNormalCosine = 0.05;  // of a normal that counts
constexpr double kSmooth = 0.95;             // cosine between normals that belong to one slope
constexpr double kFold = 0.1;     // slope of ln depth between blocks at which a fold begins
constexpr double kBridge = 1e-3;  // weight of steps across what is not seen
constexpr double kHeld = 1e-9;    // holds every part of the surface to a depth of 1

Vec2 centre_of_pixel(int x, int y) {
    return {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
}

// What a block of pixels shows.
struct Block {
    glm::dvec3 normal{0};  // the sum; then the unit normal
    int pixels = 0;
    bool seen = false;                // not continued from its neighbours
    double along_x = 0, along_y = 0;  // slopes of ln depth, by pixel
    double cosine = 0;
    int unknown = -1;  // its place in the system; −1: no evidence
};

class Blocks {
  public:
    Blocks(ViewF3 normals, ViewU8x1 matte, const ViewCamera& camera, int side);

    [[nodiscard]] Vec2 centre(int i, int j) const {
        return static_cast<float>(side_) *
               Vec2(static_cast<float>(i) + 0.5f, static_cast<float>(j) + 0.5f);
    }
    [[nodiscard]] const Block& at(int i, int j) const {
        return blocks_[static_cast<std::size_t>(j) * static_cast<std::size_t>(size_.width) +
                       static_cast<std::size_t>(i)];
    }
    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] int unknowns() const { return unknowns_; }
    // Whether a block is seen, and no fold lies beside it.
    [[nodiscard]] bool smooth(int i, int j) const;
    // ln depth of every unknown.
    [[nodiscard]] Eigen::VectorXd log_depths() const;

  private:
    [[nodiscard]] Block& at(int i, int j) {
        return const_cast<Block&>(std::as_const(*this).at(i, j));
    }
    void sum_up(ViewF3 normals, ViewU8x1 matte);
    // Continues the normals over the rectangle around all that is seen, so that parts of a surface
    // that something divides are joined: on a plane, which keeps its normal, exactly.
    void bridge();
    void find_slopes(const ViewCamera& camera);

    int side_;
    Size size_;
    std::vector<Block> blocks_;
    int unknowns_ = 0;
};

Blocks::Blocks(ViewF3 normals, ViewU8x1 matte, const ViewCamera& camera, int side)
    : side_(side), size_{normals.width() / side, normals.height() / side} {
    blocks_.resize(static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height));
    sum_up(normals, matte);
    bridge();
    find_slopes(camera);
}

// Renderers average normals over a pixel. Where a soft matte falls off it says so; the pixels at
// the edge of a hard one, as an index pass gives it, show a mixture, too.
bool at_hard_edge(ViewU8x1 matte, int x, int y) {
    return (x > 0 && matte.row(y)[x - 1] == 0) ||
           (x + 1 < matte.width() && matte.row(y)[x + 1] == 0) ||
           (y > 0 && matte.row(y - 1)[x] == 0) ||
           (y + 1 < matte.height() && matte.row(y + 1)[x] == 0);
}

void Blocks::sum_up(ViewF3 normals, ViewU8x1 matte) {
    for (int y = 0; y < size_.height * side_; ++y) {
        for (int x = 0; x < size_.width * side_; ++x) {
            if (matte.row(y)[x] != 255 || at_hard_edge(matte, x, y)) continue;
            const float* n = normals.pixel(x, y);
            if (!std::isfinite(n[0] + n[1] + n[2])) continue;
            Block& block = at(x / side_, y / side_);
            block.normal += glm::dvec3(n[0], n[1], n[2]);
            ++block.pixels;
        }
    }
    for (Block& block : blocks_) {
        const double size = glm::length(block.normal);
        // All of it is known, and it is not folded.
        block.seen = block.pixels == side_ * side_ && size >= kSmooth * block.pixels;
        block.normal = block.seen ? block.normal / size : glm::dvec3(0);
    }
}

void Blocks::bridge() {
    Recti box{};
    for (int j = 0; j < size_.height; ++j)
        for (int i = 0; i < size_.width; ++i)
            if (at(i, j).seen) box = box.united({i, j, i + 1, j + 1});
    const auto known = [&](int i, int j) {
        return box.contains(i, j) && at(i, j).normal != glm::dvec3(0);
    };
    // From the rim of what is known inwards, a ring at a time.
    for (bool any = true; any;) {
        std::vector<std::pair<Block*, glm::dvec3>> ring;
        for (int j = box.y0; j < box.y1; ++j) {
            for (int i = box.x0; i < box.x1; ++i) {
                if (known(i, j)) continue;
                glm::dvec3 sum(0);
                for (const auto& [x, y] : {std::pair{i - 1, j}, {i + 1, j}, {i, j - 1}, {i, j + 1}})
                    if (known(x, y)) sum += at(x, y).normal;
                if (const double size = glm::length(sum); size > 1e-3)
                    ring.emplace_back(&at(i, j), sum / size);
            }
        }
        for (const auto& [block, normal] : ring)
            block->normal = normal;
        any = !ring.empty();
    }
}

void Blocks::find_slopes(const ViewCamera& camera) {
    for (int j = 0; j < size_.height; ++j) {
        for (int i = 0; i < size_.width; ++i) {
            Block& block = at(i, j);
            const glm::dvec3 ray = camera.ray(centre(i, j));
            const double towards = glm::dot(block.normal, ray);
            block.cosine = -towards / glm::length(ray);
            if (block.cosine < kLeastNormalCosine) continue;
            block.along_x = -block.normal.x / (camera.focal_px * towards);
            block.along_y = -block.normal.y / (camera.focal_px * towards);
            block.unknown = unknowns_++;
        }
    }
}

bool Blocks::smooth(int i, int j) const {
    const Block& here = at(i, j);
    for (const auto& [x, y] : {std::pair{i - 1, j}, {i + 1, j}, {i, j - 1}, {i, j + 1}}) {
        if (x < 0 || y < 0 || x >= size_.width || y >= size_.height || !at(x, y).seen) continue;
        if (glm::dot(here.normal, at(x, y).normal) < kSmooth) return false;
    }
    return here.seen;
}

Eigen::VectorXd Blocks::log_depths() const {
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns_);
    const auto join = [&](const Block& a, const Block& b, double slope_a, double slope_b) {
        if (a.unknown < 0 || b.unknown < 0) return;
        const double fold = (slope_a - slope_b) * side_ / kFold;
        const double w = (a.seen && b.seen ? 1 : kBridge) / (1 + fold * fold);
        const double step = 0.5 * (slope_a + slope_b) * side_;
        for (const int k : {a.unknown, b.unknown})
            entries.emplace_back(k, k, w);
        entries.emplace_back(std::max(a.unknown, b.unknown), std::min(a.unknown, b.unknown), -w);
        right[b.unknown] += w * step;
        right[a.unknown] -= w * step;
    };
    for (int j = 0; j < size_.height; ++j) {
        for (int i = 0; i < size_.width; ++i) {
            const Block& here = at(i, j);
            if (here.unknown >= 0) entries.emplace_back(here.unknown, here.unknown, kHeld);
            if (i + 1 < size_.width) join(here, at(i + 1, j), here.along_x, at(i + 1, j).along_x);
            if (j + 1 < size_.height) join(here, at(i, j + 1), here.along_y, at(i, j + 1).along_y);
        }
    }
    Eigen::SparseMatrix<double> matrix(unknowns_, unknowns_);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::AMDOrdering<int>>
        solver(matrix);
    return solver.solve(right);
}

struct SeenMetric {
    Vec2 place{0};  // on the reference frame
    Metric metric;
    double weight = 0;
};

// Of one block at a depth of 1: tangents are ∂(z r) with z = 1.
Metric metric_of_block(const Block& block, const glm::dvec3& ray, double focal_px) {
    const glm::dvec3 x = ray * block.along_x + glm::dvec3(1 / focal_px, 0, 0);
    const glm::dvec3 y = ray * block.along_y + glm::dvec3(0, 1 / focal_px, 0);
    return {glm::dot(x, x), glm::dot(x, y), glm::dot(y, y)};
}

std::vector<SeenMetric> seen_in(const Blocks& blocks, const ViewCamera& camera,
                                const LatticeField& ref_from_cur, double weight) {
    std::vector<SeenMetric> out;
    if (blocks.unknowns() == 0) return out;
    const Eigen::VectorXd depth = blocks.log_depths();
    for (int j = 0; j < blocks.size().height; ++j) {
        for (int i = 0; i < blocks.size().width; ++i) {
            const Block& block = blocks.at(i, j);
            if (block.unknown < 0 || !blocks.smooth(i, j)) continue;
            const Vec2 at = blocks.centre(i, j);
            Metric g = metric_of_block(block, camera.ray(at), camera.focal_px);
            // Long double: see docs/decisions/0002-determinism.md.
            const auto squared =
                static_cast<double>(std::exp(2 * static_cast<long double>(depth[block.unknown])));
            g = {squared * g.xx, squared * g.xy, squared * g.yy};
            if (const auto metric = pulled_back(g, ref_from_cur, at))
                out.push_back(
                    {at + ref_from_cur.at(at), *metric, weight * block.cosine * block.cosine});
        }
    }
    return out;
}

// By how much the areas differ from what the field holds; empty if they do not meet.
std::optional<double> area_off(const MetricField& field, const std::vector<SeenMetric>& seen) {
    std::vector<double> off;
    for (const SeenMetric& s : seen)
        if (const auto before = field.log_area(s.place))
            off.push_back(log_area(s.metric) - *before);
    if (off.empty()) return std::nullopt;
    const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
    std::nth_element(off.begin(), middle, off.end());
    return *middle;
}

}  // namespace

std::optional<ImageF3> view_normals(ViewF3 normals, ViewU8x1 matte, const ViewCamera& camera,
                                    const std::array<double, 9>& r) {
    ImageF3 out(normals.size(), std::numeric_limits<float>::quiet_NaN());
    std::array<std::int64_t, 2> facing{};  // with z as it is, and the other way
    std::int64_t all = 0;
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const float* n = normals.pixel(x, y);
            const glm::dvec3 v(r[0] * n[0] + r[1] * n[1] + r[2] * n[2],
                               -(r[3] * n[0] + r[4] * n[1] + r[5] * n[2]),
                               r[6] * n[0] + r[7] * n[1] + r[8] * n[2]);
            const double size = glm::length(v);
            if (!(size > 1e-6 && size < 1e6)) continue;
            for (int c = 0; c < 3; ++c)
                out.pixel(x, y)[c] = static_cast<float>(v[c] / size);
            if (matte.row(y)[x] != 255) continue;
            const glm::dvec3 ray = camera.ray(centre_of_pixel(x, y));
            ++all;
            facing[0] += glm::dot(v, ray) < 0;
            facing[1] += glm::dot(v * glm::dvec3(1, 1, -1), ray) < 0;
        }
    }
    const bool turn = facing[1] > facing[0];
    if (static_cast<double>(all - facing[turn ? 1 : 0]) > kMostAway * static_cast<double>(all))
        return std::nullopt;
    for (int y = 0; turn && y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            out.pixel(x, y)[2] = -out.pixel(x, y)[2];
    return out;
}

void add_normals(MetricField& field, ViewF3 normals, ViewU8x1 matte, const ViewCamera& camera,
                 const LatticeField& ref_from_cur, double weight) {
    const Blocks blocks(normals, matte, camera, std::max(2, field.spacing() / 2));
    const std::vector<SeenMetric> seen = seen_in(blocks, camera, ref_from_cur, weight);
    double scale = 1;
    if (field.has_evidence()) {
        const auto off = area_off(field, seen);
        if (!off) return;
        scale = static_cast<double>(std::exp(-static_cast<long double>(*off)));
    }
    for (const SeenMetric& s : seen)
        field.add(s.place, {scale * s.metric.xx, scale * s.metric.xy, scale * s.metric.yy},
                  s.weight);
}

}  // namespace weft

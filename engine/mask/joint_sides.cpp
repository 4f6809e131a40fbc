#include "engine/mask/joint_sides.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/mask/boundary_refiner.h"
#include "engine/motion/view_mat.h"

namespace weft {
namespace {

constexpr float kCell_px = 4;  // of 854×480
constexpr float kDisagree = 0.05f;
constexpr float kShareWeight = 0.2f, kLikeWeight = 0.4f,
                kBesideWeight = 0.5f;  // weights; motion has 1
// Codes of Lab.
constexpr float kSameBeside = 6, kSameMoved = 12, kSameSide = 1.5f;

Size grid_of(Size frame) {
    const float cell_px = kCell_px * RefineScale(frame).unit_px();
    const int cell = std::max(2, static_cast<int>(std::lround(cell_px)));
    return {std::max(1, frame.width / cell), std::max(1, frame.height / cell)};
}

cv::Size as_cv(Size size) {
    return {size.width, size.height};
}

template <class T>
cv::Mat header_of(Image<T, 1>& image, int type) {
    return {image.height(), image.width(), type, image.data(),
            static_cast<std::size_t>(image.stride()) * sizeof(T)};
}

ImageU8x3 lab_cells(ViewU8x3 picture, Size grid) {
    cv::Mat small, lab;
    cv::resize(as_mat(picture), small, as_cv(grid), 0, 0, cv::INTER_AREA);
    cv::cvtColor(small, lab, cv::COLOR_RGB2Lab);
    ImageU8x3 out(grid);
    for (int y = 0; y < grid.height; ++y)
        std::copy_n(lab.ptr<std::uint8_t>(y), 3 * grid.width, out.row(y));
    return out;
}

// The share of each cell's pixels that are set.
ImageF1 shares_of(const cv::Mat& set, Size grid) {
    ImageF1 out(grid);
    cv::Mat cells = header_of(out, CV_32F), shares;
    cv::resize(set, shares, as_cv(grid), 0, 0, cv::INTER_AREA);
    shares.convertTo(cells, CV_32F, 1.0 / 255);
    return out;
}

ImageF1 mean_cells(ViewF1 values, Size grid) {
    ImageF1 out(grid);
    cv::Mat cells = header_of(out, CV_32F);
    const cv::Mat from(values.height(), values.width(), CV_32F, const_cast<float*>(values.data()),
                       static_cast<std::size_t>(values.stride()) * sizeof(float));
    cv::resize(from, cells, as_cv(grid), 0, 0, cv::INTER_AREA);
    return out;
}

// The mean place on the last frame of each cell's pixels, in cells, and the share that is reliable.
struct CellMotion {
    ImageF1 x, y, reliable;
};

CellMotion cell_motion(const FlowField& flow, Size grid) {
    CellMotion out{ImageF1(grid), ImageF1(grid), ImageF1(grid)};
    for (int y = 0; y < grid.height; ++y) {
        const int y0 = y * flow.d.height() / grid.height,
                  y1 = (y + 1) * flow.d.height() / grid.height;
        for (int x = 0; x < grid.width; ++x) {
            const int x0 = x * flow.d.width() / grid.width,
                      x1 = (x + 1) * flow.d.width() / grid.width;
            float dx = 0, dy = 0, count = 0;
            for (int j = y0; j < y1; ++j) {
                for (int i = x0; i < x1; ++i) {
                    if (flow.valid.at(i, j) == 0) continue;
                    dx += flow.d.pixel(i, j)[0];
                    dy += flow.d.pixel(i, j)[1];
                    count += 1;
                }
            }
            if (count == 0) continue;
            out.x.at(x, y) = static_cast<float>(x) + dx / count * static_cast<float>(grid.width) /
                                                         static_cast<float>(flow.d.width());
            out.y.at(x, y) = static_cast<float>(y) + dy / count * static_cast<float>(grid.height) /
                                                         static_cast<float>(flow.d.height());
            out.reliable.at(x, y) = count / static_cast<float>((x1 - x0) * (y1 - y0));
        }
    }
    return out;
}

// How alike two colours are, 0–1.
float alike(const std::uint8_t* a, const std::uint8_t* b, float scale) {
    float sum = 0;
    for (int c = 0; c < 3; ++c) {
        const auto d = static_cast<float>(a[c] - b[c]);
        sum += d * d;
    }
    return std::exp(-sum / (2 * scale * scale));
}

}  // namespace

void JointSides::remember(ViewU8x3 picture, ViewU8x1 matte) {
    const Size grid = grid_of(picture.size());
    keys_.emplace_back(lab_cells(picture, grid), shares_of(as_mat(matte) > 127, grid));
}

JointSides::Cells JointSides::cells_of(const JointFrame& in, Size grid) {
    const ImageF1 before = shares_of(as_mat(in.before) > 127, grid);
    const ImageF1 after = shares_of(as_mat(in.after) > 127, grid);
    const ImageF1 shares = in.shares.empty() ? ImageF1() : mean_cells(in.shares, grid);
    Cells out{lab_cells(in.picture, grid), ImageF1(grid), ImageF1(grid, 1.0f),
              Image<std::int32_t, 1>(grid)};
    if (!in.hidden.empty()) out.seen = shares_of(as_mat(in.hidden) == 0, grid);
    Open open_here{pull_.size(), {}};
    for (int y = 0; y < grid.height; ++y) {
        for (int x = 0; x < grid.width; ++x) {
            const float a = before.at(x, y), b = after.at(x, y);
            const float share = shares.empty() ? 0 : shares.at(x, y);
            const bool open = share > 0 && share < 1 && std::abs(a - b) > kDisagree;
            out.inside.at(x, y) = open || shares.empty() ? (a + b) / 2 : a + share * (b - a);
            out.node.at(x, y) = open ? static_cast<std::int32_t>(pull_.size()) : -1;
            if (!open) continue;
            open_here.cells.push_back(y * grid.width + x);
            pull_.push_back(kShareWeight);
            target_.push_back(kShareWeight * (a + share * (b - a)));
        }
    }
    out.any_open = !open_here.cells.empty();
    if (out.any_open) open_[in.frame] = std::move(open_here);
    return out;
}

void JointSides::tie(int a, float a_inside, int b, float b_inside, float weight) {
    if (a >= 0 && b >= 0) {
        links_.push_back({a, b, weight});
    } else if (a >= 0 || b >= 0) {
        const auto node = static_cast<std::size_t>(std::max(a, b));
        pull_[node] += weight;
        target_[node] += weight * (a >= 0 ? b_inside : a_inside);
    }
}

void JointSides::add_links(const Cells& cells) {
    const Size grid = cells.inside.size();
    const auto beside = [&](int x, int y, int i, int j) {
        const int a = cells.node.at(x, y), b = cells.node.at(i, j);
        if (a < 0 && b < 0) return;
        tie(a, cells.inside.at(x, y), b, cells.inside.at(i, j),
            kBesideWeight * alike(cells.lab.pixel(x, y), cells.lab.pixel(i, j), kSameBeside));
    };
    for (int y = 0; y < grid.height; ++y) {
        for (int x = 0; x < grid.width; ++x) {
            if (x + 1 < grid.width) beside(x, y, x + 1, y);
            if (y + 1 < grid.height) beside(x, y, x, y + 1);
        }
    }
}

void JointSides::add_motion(const JointFrame& in, const Cells& cells) {
    const Size grid = cells.inside.size();
    if (in.last_from_this == nullptr || last_.inside.size() != grid) return;
    if (!cells.any_open && !last_.any_open) return;
    const CellMotion motion = cell_motion(*in.last_from_this, grid);
    for (int y = 0; y < grid.height; ++y) {
        for (int x = 0; x < grid.width; ++x) {
            if (motion.reliable.at(x, y) <= 0) continue;
            const Vec2i there(glm::round(Vec2(motion.x.at(x, y), motion.y.at(x, y))));
            if (there.x < 0 || there.y < 0 || there.x >= grid.width || there.y >= grid.height)
                continue;
            const int a = cells.node.at(x, y), b = last_.node.at(there.x, there.y);
            if (a < 0 && b < 0) continue;
            tie(a, cells.inside.at(x, y), b, last_.inside.at(there.x, there.y),
                cells.seen.at(x, y) * motion.reliable.at(x, y) *
                    alike(cells.lab.pixel(x, y), last_.lab.pixel(there.x, there.y), kSameMoved));
        }
    }
}

// What is open is more likely of the side of a keyframe on which something looks more like it:
// inside anywhere, or outside not too far away.
void JointSides::add_likeness(int frame, const Cells& cells) {
    constexpr int kNear_cells = 12;
    if (!cells.any_open) return;
    const Open& open = open_.at(frame);
    const Size grid = cells.inside.size();
    Recti bounds;
    for (const std::int32_t cell : open.cells) {
        const Vec2i at(cell % grid.width, cell / grid.width);
        bounds = bounds.united({at.x, at.y, at.x + 1, at.y + 1});
    }
    const Recti near = bounds.grown(kNear_cells).intersected(rect_of(grid));
    constexpr float kNone = std::numeric_limits<float>::infinity();
    std::vector<SideMisses> least(open.cells.size(), {kNone, kNone});
    for (const KeyPatches& key : keys_) {
        const std::vector<SideMisses> here = key.misses(cells.lab, open.cells, near);
        for (std::size_t k = 0; k < here.size(); ++k) {
            least[k].inside = std::min(least[k].inside, here[k].inside);
            least[k].outside = std::min(least[k].outside, here[k].outside);
        }
    }
    for (std::size_t k = 0; k < open.cells.size(); ++k) {
        if (std::isinf(least[k].inside) || std::isinf(least[k].outside)) continue;
        const int cell = open.cells[k];
        const float seen = cells.seen.at(cell % grid.width, cell / grid.width);
        const float lead = (least[k].inside - least[k].outside) / kSameSide;
        const float side = 1 / (1 + std::exp(std::clamp(lead, -30.0f, 30.0f)));
        const float weight = kLikeWeight * seen * std::abs(2 * side - 1);
        pull_[open.first + k] += weight;
        target_[open.first + k] += weight * side;
    }
}

void JointSides::add(const JointFrame& in) {
    Cells cells = cells_of(in, grid_of(in.picture.size()));
    add_links(cells);
    add_motion(in, cells);
    add_likeness(in.frame, cells);
    last_ = std::move(cells);
}

void JointSides::decide() {
    const auto count = static_cast<Eigen::Index>(pull_.size());
    std::vector<Eigen::Triplet<float>> entries;
    entries.reserve(pull_.size() + 4 * links_.size());
    Eigen::VectorXf known(count), guess(count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const auto at = static_cast<std::size_t>(k);
        entries.emplace_back(k, k, pull_[at]);
        known[k] = target_[at];
        guess[k] = target_[at] / pull_[at];
    }
    for (const Link& one : links_) {
        entries.emplace_back(one.a, one.a, one.weight);
        entries.emplace_back(one.b, one.b, one.weight);
        entries.emplace_back(one.a, one.b, -one.weight);
        entries.emplace_back(one.b, one.a, -one.weight);
    }
    links_ = {};
    last_ = {};
    keys_ = {};
    if (count == 0) return;
    Eigen::SparseMatrix<float> system(count, count);
    system.setFromTriplets(entries.begin(), entries.end());
    Eigen::ConjugateGradient<Eigen::SparseMatrix<float>, Eigen::Lower | Eigen::Upper> solver;
    constexpr float kExact = 1e-4f;
    constexpr int kMostSteps = 300;
    solver.setTolerance(kExact);
    solver.setMaxIterations(kMostSteps);
    solver.compute(system);
    const Eigen::VectorXf inside = solver.solveWithGuess(known, guess);
    inside_.assign(inside.data(), inside.data() + count);
}

ImageF1 JointSides::inside(int frame, ViewU8x1 before, ViewU8x1 after) const {
    const Size grid = grid_of(before.size());
    ImageF1 cells = shares_of(as_mat(before) > 127, grid);
    const ImageF1 other = shares_of(as_mat(after) > 127, grid);
    for (int y = 0; y < grid.height; ++y)
        for (int x = 0; x < grid.width; ++x)
            cells.at(x, y) = (cells.at(x, y) + other.at(x, y)) / 2;
    if (const auto found = open_.find(frame); found != open_.end() && !inside_.empty()) {
        const Open& open = found->second;
        for (std::size_t k = 0; k < open.cells.size(); ++k)
            cells.at(open.cells[k] % grid.width, open.cells[k] / grid.width) =
                inside_[open.first + k];
    }
    ImageF1 out(before.size());
    cv::Mat wide = header_of(out, CV_32F);
    cv::resize(header_of(cells, CV_32F), wide, as_cv(before.size()), 0, 0, cv::INTER_LINEAR);
    return out;
}

}  // namespace weft

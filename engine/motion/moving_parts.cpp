#include "engine/motion/moving_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

namespace weft {
namespace {

// A cell whose motion is known.
struct Cell {
    int i, j;
    Vec2 d;
    int part = -1;  // -1: not yet explained
};

// d(p) = offset + slope · p, p in cells.
struct Affine {
    std::array<glm::dvec3, 2> rows{};  // x, y and 1
    [[nodiscard]] Vec2 at(int i, int j) const {
        const glm::dvec3 p(i, j, 1);
        return {static_cast<float>(glm::dot(rows[0], p)), static_cast<float>(glm::dot(rows[1], p))};
    }
    [[nodiscard]] float miss(const Cell& c) const { return glm::length(at(c.i, c.j) - c.d); }
};

// Weighted least squares, or nothing if the cells lie on a line.
class AffineFit {
  public:
    void add(const Cell& c, double w) {
        const glm::dvec3 p(c.i, c.j, 1);
        normal_ += w * glm::outerProduct(p, p);
        x_ += w * static_cast<double>(c.d.x) * p;
        y_ += w * static_cast<double>(c.d.y) * p;
        count_ += w > 0;
    }
    [[nodiscard]] std::optional<Affine> solve() const {
        constexpr int kFewest = 6;
        constexpr double kFlat = 1e-6;
        if (count_ < kFewest || glm::determinant(normal_) < kFlat) return std::nullopt;
        const glm::dmat3 inverse = glm::inverse(normal_);
        return Affine{{inverse * x_, inverse * y_}};
    }

  private:
    glm::dmat3 normal_{0};
    glm::dvec3 x_{0}, y_{0};
    int count_ = 0;
};

// The median by component of what is known in a cell.
std::optional<Vec2> motion_of_cell(const FlowField& flow, ViewU8x1 visible, int i, int j,
                                   int cell_px) {
    std::vector<float> x, y;
    int inside = 0;
    for (int v = j * cell_px; v < (j + 1) * cell_px; ++v) {
        for (int u = i * cell_px; u < (i + 1) * cell_px; ++u) {
            if (visible.at(u, v) < 128) continue;
            ++inside;
            if (flow.valid.at(u, v) == 0) continue;
            x.push_back(flow.d.pixel(u, v)[0]);
            y.push_back(flow.d.pixel(u, v)[1]);
        }
    }
    const auto area = static_cast<std::size_t>(cell_px) * static_cast<std::size_t>(cell_px);
    if (2 * static_cast<std::size_t>(inside) < area || 5 * x.size() < 2 * area) return std::nullopt;
    const auto median = [](std::vector<float>& v) {
        const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
        std::nth_element(v.begin(), middle, v.end());
        return *middle;
    };
    return Vec2(median(x), median(y));
}

// What agrees on one motion, and how it is told.
class Consensus {
  public:
    Consensus(const std::vector<Cell>& cells, float tolerance_px)
        : cells_(cells), tolerance_px_(tolerance_px) {}

    // The affine motion that most of the cells `among` agree on, by trying the neighbourhoods of at
    // most `most` of them.
    [[nodiscard]] std::optional<Affine> of(const std::vector<std::size_t>& among,
                                           std::size_t most) const {
        std::optional<Affine> best;
        double most_agree = 0;
        const std::size_t step = std::max<std::size_t>(1, among.size() / most);
        for (std::size_t k = 0; k < among.size(); k += step) {
            std::optional<Affine> tried = around(cells_[among[k]], among);
            for (int round = 0; tried && round < kRounds; ++round)
                tried = again(*tried, among);
            if (!tried) continue;
            double agree = 0;
            for (const std::size_t c : among)
                agree += weight(tried->miss(cells_[c]));
            if (agree <= most_agree) continue;
            most_agree = agree;
            best = tried;
        }
        return best;
    }

  private:
    static constexpr int kRounds = 6;

    [[nodiscard]] double weight(float miss_px) const {
        const double r = static_cast<double>(miss_px / tolerance_px_);
        return 1 / ((1 + r * r) * (1 + r * r));
    }
    [[nodiscard]] std::optional<Affine> around(const Cell& c,
                                               const std::vector<std::size_t>& among) const {
        constexpr int kReach = 2;  // cells
        AffineFit fit;
        for (const std::size_t k : among) {
            const Cell& o = cells_[k];
            if (std::abs(o.i - c.i) <= kReach && std::abs(o.j - c.j) <= kReach) fit.add(o, 1);
        }
        return fit.solve();
    }
    [[nodiscard]] std::optional<Affine> again(const Affine& by,
                                              const std::vector<std::size_t>& among) const {
        constexpr float kOutside = 4;
        AffineFit fit;
        for (const std::size_t k : among) {
            const float miss = by.miss(cells_[k]);
            if (miss < kOutside * tolerance_px_) fit.add(cells_[k], weight(miss));
        }
        return fit.solve();
    }

    const std::vector<Cell>& cells_;
    float tolerance_px_;
};

class Grouping {
  public:
    Grouping(const FlowField& flow, ViewU8x1 visible)
        : unit_(std::max(1.0f, static_cast<float>(visible.width()) / 480)),
          cell_px_(static_cast<int>(std::lround(8 * unit_))),
          index_(visible.width() / cell_px_, visible.height() / cell_px_, -1) {
        for (int j = 0; j < index_.height(); ++j) {
            for (int i = 0; i < index_.width(); ++i) {
                const auto d = motion_of_cell(flow, visible, i, j, cell_px_);
                if (!d) continue;
                index_.at(i, j) = static_cast<std::int32_t>(cells_.size());
                cells_.push_back({i, j, *d});
            }
        }
    }

    [[nodiscard]] MovingParts parts() {
        constexpr std::size_t kFewest = 40;
        MovingParts out;
        out.cell_px = cell_px_;
        out.of = Image<std::uint8_t, 1>(index_.size(), MovingParts::kUnknown);
        if (cells_.size() < kFewest || !settle_body()) return out;
        while (settle_part()) {
        }
        std::vector<std::uint8_t> name(static_cast<std::size_t>(found_) + 1, MovingParts::kBody);
        for (int part = 1; part <= found_; ++part) {
            if (slides(part))
                name[static_cast<std::size_t>(part)] = static_cast<std::uint8_t>(++out.count);
        }
        for (const Cell& c : cells_) {
            if (c.part >= 0) out.of.at(c.i, c.j) = name[static_cast<std::size_t>(c.part)];
        }
        return out;
    }

  private:
    [[nodiscard]] float tolerance() const {
        constexpr float kTolerance_px = 0.8f;
        return kTolerance_px * unit_;
    }
    // The cells that no motion explains.
    [[nodiscard]] std::vector<std::size_t> open() const {
        std::vector<std::size_t> out;
        for (std::size_t k = 0; k < cells_.size(); ++k) {
            if (is_open(k)) out.push_back(k);
        }
        return out;
    }
    [[nodiscard]] bool settle_body() {
        constexpr std::size_t kTries = 60;
        constexpr float kBody = 1.5f;
        given_up_.assign(cells_.size(), false);
        const auto motion = Consensus(cells_, tolerance()).of(open(), kTries);
        if (!motion) return false;
        motions_.push_back(*motion);
        for (Cell& c : cells_)
            c.part = motion->miss(c) < kBody * tolerance() ? 0 : -1;
        return true;
    }
    [[nodiscard]] bool is_open(std::size_t cell) const {
        return cells_[cell].part < 0 && !given_up_[cell];
    }
    // The largest connected piece of the cells that `belongs` takes.
    template <class Belongs>
    [[nodiscard]] std::vector<std::size_t> largest_piece(const Belongs& belongs) const {
        std::vector<bool> seen(cells_.size(), false);
        std::vector<std::size_t> largest;
        for (std::size_t first = 0; first < cells_.size(); ++first) {
            if (seen[first] || !belongs(first)) continue;
            std::vector<std::size_t> piece{first};
            seen[first] = true;
            for (std::size_t k = 0; k < piece.size(); ++k) {
                for_neighbours(cells_[piece[k]], 1, [&](std::size_t next) {
                    if (seen[next] || !belongs(next)) return;
                    seen[next] = true;
                    piece.push_back(next);
                });
            }
            if (piece.size() > largest.size()) largest = std::move(piece);
        }
        return largest;
    }
    // The known cells up to `reach` away, itself included.
    template <class Visit>
    void for_neighbours(const Cell& c, int reach, const Visit& visit) const {
        const int bottom = std::min(index_.height() - 1, c.j + reach);
        const int right = std::min(index_.width() - 1, c.i + reach);
        for (int v = std::max(0, c.j - reach); v <= bottom; ++v) {
            for (int u = std::max(0, c.i - reach); u <= right; ++u) {
                if (index_.at(u, v) >= 0) visit(static_cast<std::size_t>(index_.at(u, v)));
            }
        }
    }
    // One more part; false if none is left.
    [[nodiscard]] bool settle_part() {
        constexpr std::size_t kFewest = 8, kTries = 20;
        constexpr int kMost = 6;
        constexpr float kPart = 2;
        const auto piece = largest_piece([&](std::size_t k) { return is_open(k); });
        if (piece.size() < kFewest || found_ == kMost) return false;
        const auto motion = Consensus(cells_, tolerance()).of(piece, kTries);
        const auto agree = motion ? largest_piece([&](std::size_t k) {
            return is_open(k) && motion->miss(cells_[k]) < kPart * tolerance();
        })
                                  : std::vector<std::size_t>();
        if (agree.size() < kFewest || 10 * agree.size() < 3 * piece.size()) {
            for (const std::size_t k : piece)
                given_up_[k] = true;
            if (agree.size() < kFewest) return true;
        }
        motions_.push_back(*motion);
        ++found_;
        for (const std::size_t k : agree)
            cells_[k].part = found_;
        return true;
    }
    // Whether a part slides along what is beside it: its own motion, carried on there, misses.
    [[nodiscard]] bool slides(int part) const {
        constexpr float kJump_px = 1.5f, kOver = 0.4f;
        constexpr int kLeastBoundary = 15, kReach = 2;
        constexpr float kLeastShare = 0.03f;  // of the region's cells
        const Affine& motion = motions_[static_cast<std::size_t>(part)];
        int mine = 0, beside = 0, jumps = 0;
        for (const Cell& c : cells_) {
            mine += c.part == part;
            if (c.part == part || !is_near(c, part, kReach)) continue;
            ++beside;
            jumps += motion.miss(c) > kJump_px * unit_;
        }
        return static_cast<float>(mine) >= kLeastShare * static_cast<float>(cells_.size()) &&
               jumps >= kLeastBoundary &&
               static_cast<float>(jumps) >= kOver * static_cast<float>(beside);
    }
    [[nodiscard]] bool is_near(const Cell& c, int part, int reach) const {
        bool found = false;
        for_neighbours(c, reach, [&](std::size_t k) { found |= cells_[k].part == part; });
        return found;
    }

    float unit_;
    int cell_px_;
    Image<std::int32_t, 1> index_;  // of the cells; -1: its motion is not known
    std::vector<Cell> cells_;
    std::vector<bool> given_up_;
    std::vector<Affine> motions_;  // of the body and the parts
    int found_ = 0;
};

}  // namespace

MovingParts find_moving_parts(const FlowField& prev_from_cur, ViewU8x1 visible) {
    return Grouping(prev_from_cur, visible).parts();
}

}  // namespace weft

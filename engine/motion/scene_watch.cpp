#include "engine/motion/scene_watch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/motion/follow_size.h"

namespace weft {
namespace {

constexpr std::int64_t kMost_px = 240 * 135;
constexpr int kMostColumns = 16, kMostRows = 9, kLeastCell_px = 15;
constexpr Vec2 kOutside{-1, -1};
constexpr int kLeastCells = 12;      // that tell anything
constexpr double kLeastKnown = 0.6;  // of a cell's pixels, that lie inside the other frame
constexpr double kTexture = 2.5;     // deviation in codes: less is flat, or noise
constexpr double kAlike = 0.5;       // correlation
// Shares of cells (EVIDENCE.md, "Cuts and dissolves").
constexpr float kCut = 0.2f, kDissolved = 0.25f, kMixed = 0.16f;
// Of a frame as a mixture of an earlier and a later one.
constexpr double kLeastPart = 0.15, kMostPart = 0.9;
constexpr double kExplained = 0.7;      // of its variance
constexpr double kBetterThanOne = 0.1;  // more than by the nearer of the two alone
constexpr double kTellApart = 0.2;      // 1 - squared correlation of the two

// Sums of a cell of two pictures.
struct SceneCell {
    double n = 0, all = 0, believed = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;

    // Empty where the cell does not tell.
    [[nodiscard]] std::optional<double> correlation() const {
        if (!(n >= kLeastKnown * all) || n == 0) return std::nullopt;
        const double va = aa / n - (a / n) * (a / n), vb = bb / n - (b / n) * (b / n);
        if (va < kTexture * kTexture || vb < kTexture * kTexture) return std::nullopt;
        return (ab / n - a / n * b / n) / std::sqrt(va * vb);
    }
};

// Sums of a cell of three pictures: an earlier one, one between, and a later one.
struct MixtureCell {
    double n = 0, e = 0, m = 0, l = 0, ee = 0, mm = 0, ll = 0, em = 0, ml = 0, el = 0;

    void add(double earlier, double between, double later) {
        n += 1, e += earlier, m += between, l += later;
        ee += earlier * earlier, mm += between * between, ll += later * later;
        em += earlier * between, ml += between * later, el += earlier * later;
    }
    // Whether the one between is a mixture of the others; empty where the cell does not tell.
    [[nodiscard]] std::optional<bool> is_mixed(double all) const {
        if (!(n >= kLeastKnown * all) || n == 0) return std::nullopt;
        const double e0 = e / n, m0 = m / n, l0 = l / n;
        const double see = ee / n - e0 * e0, smm = mm / n - m0 * m0, sll = ll / n - l0 * l0;
        const double sem = em / n - e0 * m0, sml = ml / n - m0 * l0, sel = el / n - e0 * l0;
        const double determinant = see * sll - sel * sel;
        if (see < kTexture * kTexture || sll < kTexture * kTexture || smm < 1 ||
            determinant <= kTellApart * see * sll)
            return std::nullopt;
        const double of_e = (sem * sll - sml * sel) / determinant;
        const double of_l = (sml * see - sem * sel) / determinant;
        const double explained = (of_e * sem + of_l * sml) / smm;
        const double by_one = std::max(sem * sem / see, sml * sml / sll) / smm;
        return std::min(of_e, of_l) > kLeastPart && std::max(of_e, of_l) < kMostPart &&
               explained > kExplained && explained > by_one + kBetterThanOne;
    }
};

float bilinear(const Matte& picture, Vec2 p) {
    const int x = std::min(static_cast<int>(p.x), picture.width() - 2);
    const int y = std::min(static_cast<int>(p.y), picture.height() - 2);
    const float u = p.x - static_cast<float>(x), v = p.y - static_cast<float>(y);
    const std::uint8_t *top = picture.row(y) + x, *bottom = picture.row(y + 1) + x;
    const float above = static_cast<float>(top[0]) * (1 - u) + static_cast<float>(top[1]) * u;
    const float below = static_cast<float>(bottom[0]) * (1 - u) + static_cast<float>(bottom[1]) * u;
    return above * (1 - v) + below * v;
}

bool lies_inside(Vec2 p, Size size) {
    return p.x >= 0 && p.y >= 0 && p.x <= static_cast<float>(size.width - 1) &&
           p.y <= static_cast<float>(size.height - 1);
}

Vec2 motion_at(const FlowField& motion, Vec2 p) {
    const float* d =
        motion.d.pixel(static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y)));
    return {d[0], d[1]};
}

// How a picture is divided into cells.
struct CellGrid {
    explicit CellGrid(Size picture)
        : size(picture),
          columns(std::clamp(picture.width / kLeastCell_px, 1, kMostColumns)),
          rows(std::clamp(picture.height / kLeastCell_px, 1, kMostRows)) {}
    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    }
    [[nodiscard]] std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y * rows / size.height) *
                   static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(x * columns / size.width);
    }
    Size size;
    int columns, rows;
};

// Shares of the cells that tell.
struct Shares {
    float found = 1;     ///< Show what the other frame does.
    float believed = 1;  ///< And most of the motion to it is consistent both ways.
};

// Of the cells of `now`, those that show what `then` shows where `place(x, y)` says they were;
// empty if too few tell. Where `believed` is 0, motion has been fitted to chance.
template <class Place>
std::optional<Shares> share_found(const Matte& now, const Matte& then, const Matte& believed,
                                  const Place& place) {
    const CellGrid grid(now.size());
    std::vector<SceneCell> cells(grid.count());
    for (int y = 0; y < now.height(); ++y) {
        for (int x = 0; x < now.width(); ++x) {
            SceneCell& cell = cells[grid.at(x, y)];
            cell.all += 1;
            cell.believed += believed.empty() || believed.row(y)[x] != 0;
            const Vec2 from = place(x, y);
            if (!lies_inside(from, then.size())) continue;
            const double a = bilinear(then, from), b = now.row(y)[x];
            cell.n += 1, cell.a += a, cell.b += b;
            cell.aa += a * a, cell.bb += b * b, cell.ab += a * b;
        }
    }
    int told = 0, found = 0, consistent = 0;
    for (const SceneCell& cell : cells) {
        const auto correlation = cell.correlation();
        told += correlation.has_value();
        const bool alike = correlation && *correlation > kAlike;
        found += alike;
        consistent += alike && cell.believed > 0.5 * cell.all;
    }
    if (told < kLeastCells) return std::nullopt;
    const auto all = static_cast<float>(told);
    return Shares{static_cast<float>(found) / all, static_cast<float>(consistent) / all};
}

}  // namespace

SceneFrame scene_frame(ViewU8x1 luma, const FlowField& prev_from_cur) {
    const Size size = bounded_size(luma.size(), kMost_px);
    return {reduced(luma, size),
            prev_from_cur.empty() ? FlowField() : resized(prev_from_cur, size)};
}

bool SceneWatch::still_shows(std::shared_ptr<const SceneFrame> frame) {
    if (other_) return false;
    const Size size = frame->luma.size();
    if (size.width < kLeastCell_px || size.height < kLeastCell_px) return true;
    bool cut = false;
    const FlowField& motion = frame->prev_from_cur;
    if (!kept_.empty() && !motion.empty()) {
        const auto found =
            share_found(frame->luma, kept_.back()->luma, motion.valid, [&](int x, int y) {
                const Vec2 p{static_cast<float>(x), static_cast<float>(y)};
                return p + motion_at(motion, p);
            });
        cut = found && found->believed < kCut;
    }
    kept_.push_back(std::move(frame));
    if (kept_.size() > kFramesBack + 1) kept_.pop_front();
    other_ = cut || is_dissolved();
    if (other_) kept_.clear();
    return !other_;
}

bool SceneWatch::is_dissolved() const {
    if (kept_.size() < 3) return false;
    const Matte& then = kept_.front()->luma;
    const auto share = share_found(kept_.back()->luma, then, Matte(), [&](int x, int y) {
        const auto path = path_back(x, y);
        return path ? path->front() : kOutside;
    });
    return share && share->found < kDissolved && most_mixed() >= kMixed;
}

std::optional<SceneWatch::Path> SceneWatch::path_back(int x, int y) const {
    Path path{};
    Vec2 p{static_cast<float>(x), static_cast<float>(y)};
    path[kept_.size() - 1] = p;
    for (std::size_t k = kept_.size() - 1; k > 0; --k) {
        const FlowField& motion = kept_[k]->prev_from_cur;
        p += motion_at(motion, p);
        if (!lies_inside(p, motion.size())) return std::nullopt;
        path[k - 1] = p;
    }
    return path;
}

float SceneWatch::most_mixed() const {
    const Matte &then = kept_.front()->luma, &now = kept_.back()->luma;
    const CellGrid grid(now.size());
    const std::size_t between = kept_.size() - 2;
    std::vector<MixtureCell> cells(between * grid.count());
    std::vector<double> pixels(grid.count());
    for (int y = 0; y < now.height(); ++y) {
        for (int x = 0; x < now.width(); ++x) {
            const std::size_t cell = grid.at(x, y);
            pixels[cell] += 1;
            const auto path = path_back(x, y);
            if (!path) continue;
            const double earlier = bilinear(then, path->front()), later = now.row(y)[x];
            for (std::size_t k = 0; k < between; ++k)
                cells[k * grid.count() + cell].add(
                    earlier, bilinear(kept_[k + 1]->luma, (*path)[k + 1]), later);
        }
    }
    float most = 0;
    for (std::size_t k = 0; k < between; ++k) {
        int told = 0, mixed = 0;
        for (std::size_t cell = 0; cell < grid.count(); ++cell) {
            const auto is = cells[k * grid.count() + cell].is_mixed(pixels[cell]);
            told += is.has_value(), mixed += is.value_or(false);
        }
        if (told >= kLeastCells)
            most = std::max(most, static_cast<float>(mixed) / static_cast<float>(told));
    }
    return most;
}

}  // namespace weft

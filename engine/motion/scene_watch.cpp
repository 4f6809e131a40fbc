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
constexpr int kLeastCells = 12;      // that tell anything
constexpr double kLeastKnown = 0.6;  // of a cell's pixels, that lie inside the other frame
constexpr double kTexture = 2.5;     // deviation in codes: less is flat, or noise
constexpr double kAlike = 0.5;       // correlation
constexpr std::size_t kFramesBack = 12;
// Shares of cells (EVIDENCE.md, "Cuts and dissolves").
constexpr float kCut = 0.2f, kDissolved = 0.25f, kFollowed = 0.65f;

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
    const int columns = std::clamp(now.width() / kLeastCell_px, 1, kMostColumns);
    const int rows = std::clamp(now.height() / kLeastCell_px, 1, kMostRows);
    std::vector<SceneCell> cells(static_cast<std::size_t>(columns) *
                                 static_cast<std::size_t>(rows));
    for (int y = 0; y < now.height(); ++y) {
        for (int x = 0; x < now.width(); ++x) {
            SceneCell& cell = cells[static_cast<std::size_t>(y * rows / now.height()) *
                                        static_cast<std::size_t>(columns) +
                                    static_cast<std::size_t>(x * columns / now.width())];
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
    Kept now{std::move(frame)};
    bool cut = false;
    const FlowField& motion = now.frame->prev_from_cur;
    if (!kept_.empty() && !motion.empty()) {
        const auto found =
            share_found(now.frame->luma, kept_.back().frame->luma, motion.valid, [&](int x, int y) {
                const Vec2 p{static_cast<float>(x), static_cast<float>(y)};
                return p + motion_at(motion, p);
            });
        now.found = found.value_or(Shares()).found;
        cut = found && found->believed < kCut;
    }
    kept_.push_back(std::move(now));
    if (kept_.size() > kFramesBack + 1) kept_.pop_front();
    other_ = cut || is_dissolved();
    if (other_) kept_.clear();
    return !other_;
}

bool SceneWatch::is_dissolved() const {
    const bool followed =
        std::all_of(kept_.begin(), kept_.end(), [](const Kept& k) { return k.found >= kFollowed; });
    if (kept_.size() < 2 || !followed) return false;
    const Matte& then = kept_.front().frame->luma;
    const auto share = share_found(kept_.back().frame->luma, then, Matte(), [&](int x, int y) {
        Vec2 p{static_cast<float>(x), static_cast<float>(y)};
        for (std::size_t k = kept_.size() - 1; k > 0 && lies_inside(p, then.size()); --k)
            p += motion_at(kept_[k].frame->prev_from_cur, p);
        return p;
    });
    return share && share->found < kDissolved;
}

}  // namespace weft

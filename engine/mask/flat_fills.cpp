#include "engine/mask/flat_fills.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace weft {
namespace {

constexpr int kSameFill = 4;   // levels from where a fill was first met: compression, no gradient
constexpr int kSamePaint = 8;  // levels between fills of one paint
// What tells a fill from a smooth wall under grain is that neighbours are equal (drawn 0.96 of
// them, through H.264 0.65 to 0.8; walls 0.02 to 0.2), and from a piece of a gradient that its
// colours do not follow their places.
constexpr double kLeastEqual = 0.5, kMostDeviation = 2.5, kMostSlope = 0.5, kNoSlope = 0.6;
constexpr int kLeastArea = 24;  // px; less is the antialiasing of lines

using Color = std::array<int, 3>;

int largest_difference(const Color& a, const Color& b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

Color color_at(ViewU8x3 frame, int x, int y) {
    const std::uint8_t* p = frame.pixel(x, y);
    return {p[0], p[1], p[2]};
}

struct Fill {
    Color color;
    std::int64_t area = 0, inside = 0;  // px; those on the inner side of the boundary
    bool thick = false;                 // else a line
    bool even = true;                   // else grain, or a piece of a gradient
};

// How the brightness of a fill's pixels deviates, levels, and the share of it that a plane over
// their places explains.
struct Spread {
    double deviation = 0, by_place = 0;
};

Spread spread_of(ViewU8x3 frame, const std::vector<Vec2i>& members) {
    const auto n = static_cast<double>(members.size());
    const auto value = [&](const Vec2i& p) {
        const Color color = color_at(frame, p.x, p.y);
        return (color[0] + color[1] + color[2]) / 3.0;
    };
    double mx = 0, my = 0, mv = 0;
    for (const Vec2i& p : members)
        mx += p.x / n, my += p.y / n, mv += value(p) / n;
    double xx = 0, xy = 0, yy = 0, xv = 0, yv = 0, vv = 0;
    for (const Vec2i& p : members) {
        const double x = p.x - mx, y = p.y - my, v = value(p) - mv;
        xx += x * x, xy += x * y, yy += y * y, xv += x * v, yv += y * v, vv += v * v;
    }
    const double det = xx * yy - xy * xy;
    if (!(vv > 0) || !(det > 0)) return {std::sqrt(vv / n), 0};
    const double a = (xv * yy - yv * xy) / det, b = (yv * xx - xv * xy) / det;
    return {std::sqrt(vv / n), (a * xv + b * yv) / vv};
}

// Whether all of a fill's pixels are one colour, but for what compression does to it.
bool is_even(ViewU8x3 frame, const Image<std::int32_t, 1>& of, const std::vector<Vec2i>& members) {
    std::int64_t pairs = 0, equal = 0;
    for (const Vec2i& p : members) {
        if (p.x + 1 == frame.width() || of.at(p.x + 1, p.y) != of.at(p.x, p.y)) continue;
        ++pairs;
        equal += largest_difference(color_at(frame, p.x, p.y), color_at(frame, p.x + 1, p.y)) <= 1;
    }
    if (static_cast<double>(equal) < kLeastEqual * static_cast<double>(pairs)) return false;
    const Spread spread = spread_of(frame, members);
    return spread.deviation < kNoSlope ||
           (spread.deviation < kMostDeviation && spread.by_place < kMostSlope);
}

// Whether the colour around (x, y) is the fill's: beside lines, compression leaves ringing.
bool is_calm(ViewU8x3 frame, int x, int y) {
    constexpr int kRinging = 2;  // levels
    const Color own = color_at(frame, x, y);
    for (int v = std::max(0, y - 1); v <= std::min(frame.height() - 1, y + 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(frame.width() - 1, x + 1); ++u) {
            if (largest_difference(own, color_at(frame, u, v)) > kRinging) return false;
        }
    }
    return true;
}

// Every connected set of pixels of one colour, and which of them each pixel is of: −1 for what is
// none, lines and their edges.
struct Fills {
    Image<std::int32_t, 1> of;
    std::vector<Fill> all;
};

// Lines of ink are flat, too, but nowhere as wide as a fill; they become none.
void mark_thick(Fills& fills) {
    constexpr int kHalf = 2;  // px
    Image<std::int32_t, 1>& of = fills.of;
    for (int y = kHalf; y < of.height() - kHalf; ++y) {
        for (int x = kHalf; x < of.width() - kHalf; ++x) {
            const std::int32_t own = of.at(x, y);
            if (own < 0 || fills.all[static_cast<std::size_t>(own)].thick) continue;
            bool same = true;
            for (int dy = -kHalf; same && dy <= kHalf; dy += kHalf) {
                for (int dx = -kHalf; same && dx <= kHalf; dx += kHalf)
                    same = of.at(x + dx, y + dy) == own;
            }
            fills.all[static_cast<std::size_t>(own)].thick = same;
        }
    }
    for (int y = 0; y < of.height(); ++y) {
        for (int x = 0; x < of.width(); ++x) {
            if (of.at(x, y) >= 0 && !fills.all[static_cast<std::size_t>(of.at(x, y))].thick)
                of.at(x, y) = -1;
        }
    }
}

constexpr std::int32_t kNew = -2, kNoFill = -1;

// Adds the fill around a pixel that is of none yet.
void grow_fill(ViewU8x3 frame, ViewF1 phi, Vec2i from, Fills& out, std::vector<Vec2i>& members) {
    Fill fill{color_at(frame, from.x, from.y)};
    const auto label = static_cast<std::int32_t>(out.all.size());
    members.assign(1, from);
    out.of.at(from.x, from.y) = label;
    for (std::size_t k = 0; k < members.size(); ++k) {
        const Vec2i p = members[k];
        fill.inside += phi.row(p.y)[p.x] > 0;
        for (const Vec2i step : {Vec2i(1, 0), Vec2i(-1, 0), Vec2i(0, 1), Vec2i(0, -1)}) {
            const Vec2i q = p + step;
            if (q.x < 0 || q.y < 0 || q.x >= frame.width() || q.y >= frame.height()) continue;
            if (out.of.at(q.x, q.y) != kNew ||
                largest_difference(color_at(frame, q.x, q.y), fill.color) > kSameFill)
                continue;
            out.of.at(q.x, q.y) = label;
            members.push_back(q);
        }
    }
    fill.area = static_cast<std::int64_t>(members.size());
    if (fill.area >= kLeastArea) {
        fill.even = is_even(frame, out.of, members);
        out.all.push_back(fill);
        return;
    }
    for (const Vec2i& p : members)
        out.of.at(p.x, p.y) = kNoFill;
}

Fills fills_of(ViewU8x3 frame, ViewF1 phi) {
    Fills out{Image<std::int32_t, 1>(frame.size(), kNew), {}};
    std::vector<Vec2i> members;
    for (const bool calm : {true, false}) {
        for (int y = 0; y < frame.height(); ++y) {
            for (int x = 0; x < frame.width(); ++x) {
                if (out.of.at(x, y) == kNew && (!calm || is_calm(frame, x, y)))
                    grow_fill(frame, phi, {x, y}, out, members);
            }
        }
    }
    mark_thick(out);
    return out;
}

enum class Decision : std::uint8_t { kAsFound, kInside, kOutside };

constexpr int kWidestLine = 12;  // px

// Where there are no fills, and more than lines: what is painted in many colours or has grain.
cv::Mat textured(const Image<std::int32_t, 1>& of, const Recti& box) {
    cv::Mat none(box.height(), box.width(), CV_8U), distance;
    for (int y = 0; y < box.height(); ++y) {
        for (int x = 0; x < box.width(); ++x)
            none.at<std::uint8_t>(y, x) = of.at(box.x0 + x, box.y0 + y) < 0 ? 255 : 0;
    }
    cv::distanceTransform(none, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    const cv::Mat thin = distance <= kWidestLine / 2;
    cv::distanceTransform(thin, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    return none & (distance <= kWidestLine / 2 + 1);
}

// Whether a pixel is of the surface, if its fill is decided so.
bool is_own(const Fills& fills, ViewF1 phi, const std::vector<Decision>& decided, int x, int y) {
    const std::int32_t fill = fills.of.at(x, y);
    const Decision how = fill < 0 ? Decision::kAsFound : decided[static_cast<std::size_t>(fill)];
    return how == Decision::kAsFound ? phi.row(y)[x] > 0 : how == Decision::kInside;
}

// Around what is the surface's: with as much as says whether what lies there is a line.
Recti box_around_surface(const Fills& fills, ViewF1 phi, const std::vector<Decision>& decided) {
    Recti box{phi.width(), phi.height(), 0, 0};
    for (int y = 0; y < phi.height(); ++y) {
        for (int x = 0; x < phi.width(); ++x) {
            if (phi.row(y)[x] <= 0 && !is_own(fills, phi, decided, x, y)) continue;
            box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1),
                   std::max(box.y1, y + 1)};
        }
    }
    if (box.empty()) return {};
    return box.grown(LineHabit::kSees_px + kWidestLine + 1).intersected(rect_of(phi.size()));
}

// Which side each pixel's fill is on, in `box`.
FillSides sides_of(const Fills& fills, ViewF1 phi, const std::vector<Decision>& decided,
                   const Recti& box) {
    FillSides out(box.size());
    const cv::Mat no_line = textured(fills.of, box);
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x) {
            const int u = x - box.x0, v = y - box.y0;
            if (fills.of.at(x, y) < 0 && no_line.at<std::uint8_t>(v, u) == 0) continue;
            out.at(u, v) = is_own(fills, phi, decided, x, y) ? 1 : 2;
        }
    }
    return out;
}

// How many of the surface's neighbouring pixels are equal.
double equal_share(ViewU8x3 frame, ViewF1 phi) {
    std::int64_t pairs = 0, equal = 0;
    for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x + 1 < frame.width(); ++x) {
            if (phi.row(y)[x] <= 0 || phi.row(y)[x + 1] <= 0) continue;
            ++pairs;
            equal += largest_difference(color_at(frame, x, y), color_at(frame, x + 1, y)) <= 1;
        }
    }
    return pairs == 0 ? 0 : static_cast<double>(equal) / static_cast<double>(pairs);
}

// Of the steps out of a fill on the surface, the share that leads into another one without any
// edge. Fills of a drawing end at lines or at another paint; the pieces of a shirt's shading do not
// end.
double runs_on(ViewU8x3 frame, ViewF1 phi, const Fills& fills) {
    std::int64_t steps = 0, soft = 0;
    const auto count = [&](Vec2i p, Vec2i q) {
        const std::int32_t a = fills.of.at(p.x, p.y), b = fills.of.at(q.x, q.y);
        if (a == b || (a < 0 && b < 0) || phi.row(p.y)[p.x] <= 0 || phi.row(q.y)[q.x] <= 0) return;
        ++steps;
        soft +=
            a >= 0 && b >= 0 &&
            largest_difference(color_at(frame, p.x, p.y), color_at(frame, q.x, q.y)) <= kSameFill;
    };
    for (int y = 0; y + 1 < frame.height(); ++y) {
        for (int x = 0; x + 1 < frame.width(); ++x) {
            count({x, y}, {x + 1, y});
            count({x, y}, {x, y + 1});
        }
    }
    return steps == 0 ? 0 : static_cast<double>(soft) / static_cast<double>(steps);
}

}  // namespace

FlatFills::FlatFills(ViewU8x3 frame, ViewF1 phi) {
    constexpr double kMostly = 0.6, kDivided = 0.05;
    // Drawings have 0, through H.264 0.01 to 0.2; a white shirt and a painted wall of a phone's
    // film 0.65 and 0.33.
    constexpr double kMostRunsOn = 0.25;
    // Film and renderings need no search: what is mostly even fills has more equal neighbours.
    constexpr double kEnoughEqual = 0.8 * kMostly * kLeastEqual;
    if (equal_share(frame, phi) < kEnoughEqual) return;
    const Fills fills = fills_of(frame, phi);
    if (runs_on(frame, phi, fills) > kMostRunsOn) return;
    std::int64_t inside = 0, flat = 0;
    for (int y = 0; y < frame.height(); ++y) {
        const float* row = phi.row(y);
        inside += std::count_if(row, row + frame.width(), [](float d) { return d > 0; });
    }
    for (const Fill& fill : fills.all) {
        if (!fill.thick || !fill.even) continue;
        flat += fill.inside;
        const double share = static_cast<double>(fill.inside) / static_cast<double>(fill.area);
        auto paint = std::find_if(paints_.begin(), paints_.end(), [&](const Paint& p) {
            return largest_difference(p.color, fill.color) <= kSamePaint;
        });
        if (paint == paints_.end()) paint = paints_.insert(paint, Paint{fill.color});
        paint->inside += fill.inside;
        paint->outside += fill.area - fill.inside;
        paint->divided = paint->divided || (share > kDivided && share < 1 - kDivided);
    }
    if (static_cast<double>(flat) < kMostly * static_cast<double>(inside) || inside == 0) {
        paints_.clear();
        return;
    }
    const std::vector<Decision> as_painted(fills.all.size(), Decision::kAsFound);
    const Recti box = box_around_surface(fills, phi, as_painted);
    lines_ = LineHabit(sides_of(fills, phi, as_painted, box), phi.crop(box));
}

const FlatFills::Paint* FlatFills::paint_of(const std::array<int, 3>& color) const {
    const auto nearest =
        std::min_element(paints_.begin(), paints_.end(), [&](const Paint& a, const Paint& b) {
            return largest_difference(a.color, color) < largest_difference(b.color, color);
        });
    return nearest == paints_.end() || largest_difference(nearest->color, color) > kSamePaint
               ? nullptr
               : &*nearest;
}

Matte FlatFills::corrected(ViewU8x3 frame, ViewF1 phi) const {
    if (paints_.empty()) return {};
    // Of a paint: hardly a pixel of the other side, which is where the boundary is off by a line.
    constexpr double kAlone = 0.98;
    constexpr double kFound = 0.05;  // of a fill: it is the surface's and not another thing's
    const Fills fills = fills_of(frame, phi);
    std::vector<Decision> decided(fills.all.size(), Decision::kAsFound);
    for (std::size_t k = 0; k < fills.all.size(); ++k) {
        const Fill& fill = fills.all[k];
        if (fill.inside == 0 || !fill.thick || !fill.even) continue;
        const Paint* paint = paint_of(fill.color);
        if (!paint || paint->divided) continue;
        const double own = static_cast<double>(paint->inside) /
                           static_cast<double>(paint->inside + paint->outside);
        const double found = static_cast<double>(fill.inside) / static_cast<double>(fill.area);
        if (own < 1 - kAlone)
            decided[k] = Decision::kOutside;
        else if (own > kAlone)
            decided[k] = found > kFound ? Decision::kInside : Decision::kAsFound;
        else
            decided[k] = found > 0.5 ? Decision::kInside : Decision::kOutside;
    }
    const Recti box = box_around_surface(fills, phi, decided);
    if (box.empty()) return {};
    const Matte own = lines_.complete(sides_of(fills, phi, decided, box));
    bool differs = false;
    Matte out(frame.size());
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x) {
            out.at(x, y) = own.at(x - box.x0, y - box.y0);
            differs = differs || (out.at(x, y) != 0) != (phi.row(y)[x] > 0);
        }
    }
    return differs ? std::move(out) : Matte();
}

}  // namespace weft

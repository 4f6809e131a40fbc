#include "engine/mask/level_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr int kTaskColumns = 64;  // columns that one task sweeps
constexpr float kNoCrossing = -1e9f;
constexpr float kMostOfWay = 0.999f;  // of a way to the next pixel, so that it is not in its cell
constexpr float kRefined_px = 8;      // up to which lines count instead of their ends
constexpr float kFull = 0.99f, kEmpty = 0.01f;  // coverage of pixels that an edge does not touch

// Where the line crosses from the value `b` to `c`, 0–1; `a` and `d` are the values before and
// after, `far_a` and `far_d` those beyond. Across an edge that these six contain the sum of the
// coverage is its place.
float crossing(float far_a, float a, float b, float c, float d, float far_d, float level) {
    if (level == 0.5f) {
        const float first = std::max(far_a, far_d), last = std::min(far_a, far_d);
        if (first >= kFull && last <= kEmpty) {
            const float sum = a + b + c + d;
            const float place = far_a > far_d ? sum - 1.5f : 2.5f - sum;
            if (place >= 0 && place <= 1) return std::min(place, kMostOfWay);
        }
    }
    return std::min((level - b) / (c - b), kMostOfWay);
}

// The crossings of an image, by the edges of the grid of pixel centres.
class Crossings {
  public:
    Crossings(ViewF1 alpha, float level) : alpha_(alpha), level_(level) {}

    [[nodiscard]] bool inside(int x, int y) const { return alpha_.row(y)[x] >= level_; }
    [[nodiscard]] bool crosses_down(int x, int y) const { return inside(x, y) != inside(x, y + 1); }
    // True if any of `count` columns from x on crosses between the rows y and y + 1.
    [[nodiscard]] bool any_down(int x, int count, int y) const {
        const float* a = alpha_.row(y) + x;
        const float* b = alpha_.row(y + 1) + x;
        int any = 0;
        for (int i = 0; i < count; ++i)
            any |= (a[i] >= level_ ? 1 : 0) ^ (b[i] >= level_ ? 1 : 0);
        return any != 0;
    }
    // Between (x, y) and (x, y + 1), 0–1.
    [[nodiscard]] float down(int x, int y) const {
        const auto at = [&](int v) { return alpha_.row(std::clamp(v, 0, alpha_.height() - 1))[x]; };
        return crossing(at(y - 2), at(y - 1), at(y), at(y + 1), at(y + 2), at(y + 3), level_);
    }
    // Between (x, y) and (x + 1, y), 0–1.
    [[nodiscard]] float right(int x, int y) const {
        const float* row = alpha_.row(y);
        const auto at = [&](int u) { return row[std::clamp(u, 0, alpha_.width() - 1)]; };
        return crossing(at(x - 2), at(x - 1), at(x), at(x + 1), at(x + 2), at(x + 3), level_);
    }
    // Square of the distance of (px, py) from the line in the cell of the pixels (x, y) to
    // (x + 1, y + 1).
    [[nodiscard]] double square_in_cell(int x, int y, double px, double py) const;

  private:
    ViewF1 alpha_;
    float level_;
};

struct Point {
    double x, y;
};

double square_to_segment(Point a, Point b, Point p) {
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double length = dx * dx + dy * dy;
    double along = length > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / length : 0;
    along = std::clamp(along, 0.0, 1.0);
    const double ex = a.x + along * dx - p.x, ey = a.y + along * dy - p.y;
    return ex * ex + ey * ey;
}

double Crossings::square_in_cell(int x, int y, double px, double py) const {
    constexpr double kFar = std::numeric_limits<double>::max();
    if (x < 0 || y < 0 || x + 1 >= alpha_.width() || y + 1 >= alpha_.height()) return kFar;
    const bool tl = inside(x, y), tr = inside(x + 1, y);
    const bool bl = inside(x, y + 1), br = inside(x + 1, y + 1);
    std::array<Point, 4> at{};  // top, right, bottom, left
    int count = 0;
    const auto dx = static_cast<double>(x), dy = static_cast<double>(y);
    if (tl != tr) at[static_cast<std::size_t>(count++)] = {dx + right(x, y), dy};
    if (tr != br) at[static_cast<std::size_t>(count++)] = {dx + 1, dy + down(x + 1, y)};
    if (bl != br) at[static_cast<std::size_t>(count++)] = {dx + right(x, y + 1), dy + 1};
    if (tl != bl) at[static_cast<std::size_t>(count++)] = {dx, dy + down(x, y)};
    const Point p{px, py};
    if (count == 2) return square_to_segment(at[0], at[1], p);
    if (count != 4) return kFar;
    // Two lines; the mean says which corners belong together.
    const float mean = 0.25f * (alpha_.row(y)[x] + alpha_.row(y)[x + 1] + alpha_.row(y + 1)[x] +
                                alpha_.row(y + 1)[x + 1]);
    const bool joins = (mean >= level_) == tl;  // top left with bottom right
    return joins ? std::min(square_to_segment(at[0], at[1], p), square_to_segment(at[2], at[3], p))
                 : std::min(square_to_segment(at[0], at[3], p), square_to_segment(at[1], at[2], p));
}

// Sweeps the columns from x0 on, up to kTaskColumns of them, and remembers the last crossing of
// each.
class ColumnSweep {
  public:
    ColumnSweep(const Crossings& lines, int x0, int count) : lines_(lines), x0_(x0), count_(count) {
        last_.fill(kNoCrossing);
    }
    // Passes between the rows y and y + 1.
    void pass(int y) {
        if (!lines_.any_down(x0_, count_, y)) return;
        for (int i = 0; i < count_; ++i) {
            if (!lines_.crosses_down(x0_ + i, y)) continue;
            last_[static_cast<std::size_t>(i)] = static_cast<float>(y) + lines_.down(x0_ + i, y);
            met_ = true;
        }
    }
    [[nodiscard]] bool met() const { return met_; }
    [[nodiscard]] const float* last() const { return last_.data(); }

  private:
    const Crossings& lines_;
    int x0_, count_;
    bool met_ = false;
    std::array<float, kTaskColumns> last_{};
};

// The nearest crossing in the pixel's own column: its y, or kNoCrossing.
ImageF1 nearest_in_columns(const Crossings& lines, Size size) {
    ImageF1 near(size, kNoCrossing);
    const auto blocks = static_cast<std::size_t>((size.width + kTaskColumns - 1) / kTaskColumns);
    parallel_for(blocks, [&](std::size_t block) {
        const int x0 = static_cast<int>(block) * kTaskColumns;
        const int count = std::min(kTaskColumns, size.width - x0);
        ColumnSweep down(lines, x0, count);
        for (int y = 1; y < size.height; ++y) {
            down.pass(y - 1);
            if (down.met()) std::copy_n(down.last(), count, near.row(y) + x0);
        }
        ColumnSweep up(lines, x0, count);
        for (int y = size.height - 2; y >= 0; --y) {
            up.pass(y);
            if (!up.met()) continue;
            const auto here = static_cast<float>(y);
            const float* below = up.last();
            float* above = near.row(y) + x0;
            // A crossing that is not there is far away.
            for (int i = 0; i < count; ++i) {
                const float to_below = below[i] == kNoCrossing ? -kNoCrossing : below[i] - here;
                above[i] = to_below < here - above[i] ? below[i] : above[i];
            }
        }
    });
    return near;
}

// A parabola of the lower envelope: a column with its crossing.
struct Site {
    int x;
    float y;        // of the crossing
    double square;  // of its distance from the row
    double from;    // where the parabola becomes the lowest
};

// Of one row: the lower envelope of what the columns know.
void row_envelope(const float* near, int width, int y, float reach, std::vector<Site>& sites) {
    sites.clear();
    for (int x = 0; x < width; ++x) {
        if (near[x] == kNoCrossing) continue;
        const double g = static_cast<double>(near[x]) - y;
        if (std::abs(g) > reach) continue;
        Site site{x, near[x], g * g, -std::numeric_limits<double>::infinity()};
        while (!sites.empty()) {
            const Site& top = sites.back();
            const double dx = static_cast<double>(x) - top.x;
            const double sum = static_cast<double>(x) + top.x;
            site.from = (site.square - top.square + sum * dx) / (2 * dx);
            if (site.from > top.from) break;
            sites.pop_back();
            site.from = -std::numeric_limits<double>::infinity();
        }
        sites.push_back(site);
    }
}

// Distances to the lines where they cross columns, up to `reach`.
ImageF1 distance_by_columns(ViewF1 alpha, float level, float reach) {
    const Crossings lines(alpha, level);
    const ImageF1 near = nearest_in_columns(lines, alpha.size());
    ImageF1 out(alpha.size(), reach);
    parallel_rows(alpha.height(), 16, [&](int y0, int y1) {
        std::vector<Site> sites;
        for (int y = y0; y < y1; ++y) {
            row_envelope(near.row(y), alpha.width(), y, reach, sites);
            for (std::size_t k = 0; k < sites.size(); ++k) {
                const Site& site = sites[k];
                const double end =
                    k + 1 < sites.size() ? sites[k + 1].from : static_cast<double>(alpha.width());
                const double most = std::sqrt(std::max(0.0, reach * reach - site.square));
                int x = static_cast<int>(std::ceil(std::max({0.0, site.from, site.x - most})));
                for (; x < alpha.width() && x < end && x <= site.x + most; ++x) {
                    const double dx = static_cast<double>(x) - site.x;
                    double square = dx * dx + site.square;
                    if (square < kRefined_px * kRefined_px) {
                        const int v = static_cast<int>(std::floor(site.y));
                        for (const int u : {site.x - 1, site.x})
                            square = std::min(square, lines.square_in_cell(u, v, x, y));
                    }
                    float& d = out.row(y)[x];
                    d = std::min(d, static_cast<float>(std::sqrt(square)));
                }
            }
        }
    });
    return out;
}

ImageF1 transposed(ViewF1 image) {
    ImageF1 out(image.height(), image.width());
    constexpr int kTile = 32;
    parallel_rows(image.height(), kTile, [&](int y0, int y1) {
        for (int x0 = 0; x0 < image.width(); x0 += kTile) {
            const int x1 = std::min(x0 + kTile, image.width());
            for (int x = x0; x < x1; ++x)
                for (int y = y0; y < y1; ++y)
                    out.row(x)[y] = image.row(y)[x];
        }
    });
    return out;
}

}  // namespace

ImageF1 level_distance(ViewF1 alpha, float level, float reach_px) {
    ImageF1 out = distance_by_columns(alpha, level, reach_px);
    const ImageF1 turned = transposed(distance_by_columns(transposed(alpha), level, reach_px));
    parallel_rows(alpha.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < alpha.width(); ++x) {
                float& d = out.row(y)[x];
                d = std::min(d, turned.row(y)[x]);
                if (!(alpha.row(y)[x] >= level)) d = -d;
            }
        }
    });
    return out;
}

}  // namespace weft

#include "engine/composite/registered_block.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/core/linear_system.h"
#include "engine/core/luma.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr int kSide = RegisteredBlock::kSide;
constexpr int kOuter = kSide + 2 * RegisteredBlock::kBorder;
constexpr int kSearchReach = 6;  // half pixels of the search, to each side
constexpr int kRounds = 3;
constexpr float kLongestStep = 0.5f;

// Motion and light that are smooth over a block: displacement and its slopes, brightness and gain.
constexpr std::size_t kTerms = 10;
using Terms = std::array<float, kTerms>;

ImageF1 luma_picture(ViewF3 picture) {
    ImageF1 out(picture.size());
    parallel_rows(picture.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < picture.width(); ++x)
                out.row(y)[x] = luma_601(picture.pixel(x, y));
        }
    });
    return out;
}

ImageF1 halved(const ImageF1& plane) {
    ImageF1 out(plane.width() / 2, plane.height() / 2);
    for (int y = 0; y < out.height(); ++y) {
        const float* a = plane.row(2 * y);
        const float* b = plane.row(2 * y + 1);
        for (int x = 0; x < out.width(); ++x)
            out.row(y)[x] = 0.25f * (a[2 * x] + a[2 * x + 1] + b[2 * x] + b[2 * x + 1]);
    }
    return out;
}

// Catmull-Rom weights (Keys 1981, a = -1/2).
std::array<float, 4> cubic(float t) {
    const float t2 = t * t, t3 = t2 * t;
    return {0.5f * (-t + 2 * t2 - t3), 0.5f * (2 - 5 * t2 + 3 * t3), 0.5f * (t + 4 * t2 - 3 * t3),
            0.5f * (t3 - t2)};
}

bool wholly_visible(ViewU8x1 visible, const Recti& box) {
    if (box.x0 < 0 || box.y0 < 0 || box.x1 > visible.width() || box.y1 > visible.height())
        return false;
    for (int y = box.y0; y < box.y1; ++y) {
        const std::uint8_t* v = visible.row(y);
        if (std::any_of(v + box.x0, v + box.x1, [](std::uint8_t m) { return m != 255; }))
            return false;
    }
    return true;
}

// Variance of the difference of two windows; empty beyond the frame.
std::optional<float> unlikeness(const ImageF1& a, Vec2i at, const ImageF1& b, Vec2i to, int side) {
    if (to.x < 0 || to.y < 0 || to.x + side > b.width() || to.y + side > b.height() ||
        at.x + side > a.width() || at.y + side > a.height())
        return std::nullopt;
    float sum = 0, squares = 0;
    for (int y = 0; y < side; ++y) {
        const float* p = a.row(at.y + y) + at.x;
        const float* q = b.row(to.y + y) + to.x;
        for (int x = 0; x < side; ++x) {
            const float d = p[x] - q[x];
            sum += d, squares += d * d;
        }
    }
    return squares - sum * sum / static_cast<float>(side * side);
}

// The best integer displacement within `reach` of `middles`; the first on a tie.
Vec2i best_place(const ImageF1& a, Vec2i at, const ImageF1& b, int side, int reach,
                 const std::array<Vec2i, 2>& middles) {
    Vec2i best = middles[0];
    float least = -1;
    for (std::size_t k = 0; k < (middles[0] == middles[1] ? 1 : 2); ++k) {
        for (int v = -reach; v <= reach; ++v) {
            for (int u = -reach; u <= reach; ++u) {
                const Vec2i d{middles[k].x + u, middles[k].y + v};
                const auto cost = unlikeness(a, at, b, {at.x + d.x, at.y + d.y}, side);
                if (cost && (least < 0 || *cost < least)) least = *cost, best = d;
            }
        }
    }
    return best;
}

// A frame's block, moved by `whole` pixels and a fraction.
bool cut(ViewF3 picture, ViewU8x1 visible, Vec2i corner, std::array<float, 2> move, ImageF3& out) {
    const int ix = static_cast<int>(std::floor(move[0])),
              iy = static_cast<int>(std::floor(move[1]));
    const Recti box{corner.x + ix - 1, corner.y + iy - 1, corner.x + ix + kOuter + 2,
                    corner.y + iy + kOuter + 2};
    if (!wholly_visible(visible, box)) return false;
    const auto wx = cubic(move[0] - static_cast<float>(ix));
    const auto wy = cubic(move[1] - static_cast<float>(iy));
    std::array<float, std::size_t{3} * kOuter*(kOuter + 3)> rows{};
    for (int y = 0; y < kOuter + 3; ++y) {
        float* to = rows.data() + static_cast<std::ptrdiff_t>(3) * kOuter * y;
        for (std::size_t k = 0; k < 4; ++k) {
            const float* from = picture.pixel(box.x0 + static_cast<int>(k), box.y0 + y);
            for (int i = 0; i < 3 * kOuter; ++i)
                to[i] += wx[k] * from[i];
        }
    }
    for (int y = 0; y < kOuter; ++y) {
        float* to = out.row(y);
        std::fill(to, to + static_cast<std::ptrdiff_t>(3) * kOuter, 0.0f);
        for (int k = 0; k < 4; ++k) {
            const float* from = rows.data() + static_cast<std::ptrdiff_t>(3) * kOuter * (y + k);
            for (int i = 0; i < 3 * kOuter; ++i)
                to[i] += wy[static_cast<std::size_t>(k)] * from[i];
        }
    }
    return true;
}

// How a small motion and a change of light change a plane's value at (x, y).
Terms terms_at(const ImageF1& plane, float middle, int x, int y) {
    const float gx = 0.5f * (plane.row(y)[x + 1] - plane.row(y)[x - 1]);
    const float gy = 0.5f * (plane.row(y + 1)[x] - plane.row(y - 1)[x]);
    const float u = 2.0f * static_cast<float>(x) / (kOuter - 1) - 1.0f;
    const float v = 2.0f * static_cast<float>(y) / (kOuter - 1) - 1.0f;
    return {gx, gy, gx * u, gx * v, gy * u, gy * v, 1.0f, plane.row(y)[x] - middle, u, v};
}

// Least squares of `difference` on the terms of `plane`, inside of the border.
Terms fitted(const ImageF1& plane, float middle, const ImageF1& difference) {
    LinearSystem<kTerms> m{};
    for (int y = 1; y <= kSide; ++y) {
        for (int x = 1; x <= kSide; ++x) {
            const Terms t = terms_at(plane, middle, x, y);
            for (std::size_t i = 0; i < kTerms; ++i) {
                for (std::size_t j = i; j < kTerms; ++j)
                    m[i][j] += t[i] * t[j];
                m[i][kTerms] += t[i] * difference.row(y)[x];
            }
        }
    }
    for (std::size_t i = 0; i < kTerms; ++i) {
        for (std::size_t j = 0; j < i; ++j)
            m[i][j] = m[j][i];
    }
    // The ridge, a thousandth of a level per pixel, keeps the matrix of flat blocks positive
    // definite.
    constexpr double kSmallRidge = 1.5e-11 * kSide * kSide;
    for (std::size_t i = 0; i < kTerms; ++i)
        m[i][i] = m[i][i] * (1 + 1e-6) + kSmallRidge;
    Terms out{};
    const std::array<double, kTerms> solution = solve(m);
    std::transform(solution.begin(), solution.end(), out.begin(),
                   [](double v) { return static_cast<float>(v); });
    return out;
}

float mean_of(const ImageF1& plane) {
    double sum = 0;
    for (int y = 0; y < plane.height(); ++y) {
        for (int x = 0; x < plane.width(); ++x)
            sum += plane.row(y)[x];
    }
    return static_cast<float>(sum / (static_cast<double>(plane.width()) * plane.height()));
}

std::array<float, 4> lags_of(float move) {
    const auto w = cubic(move - std::floor(move));
    std::array<float, 4> out{};
    for (std::size_t lag = 0; lag < 4; ++lag) {
        for (std::size_t k = 0; k + lag < 4; ++k)
            out[lag] += w[k] * w[k + lag];
    }
    return out;
}

// Both frames' blocks at a displacement.
struct Cuts {
    ImageF3 current{kOuter, kOuter}, previous{kOuter, kOuter};

    bool take(const BlockPair& pair, Vec2i outer, Vec2i whole, std::array<float, 2> part) {
        const std::array<float, 2> back{-0.5f * part[0], -0.5f * part[1]},
            on{0.5f * part[0], 0.5f * part[1]};
        return cut(pair.current, pair.visible, outer, back, current) &&
               cut(pair.previous, pair.previous_visible, {outer.x + whole.x, outer.y + whole.y}, on,
                   previous);
    }
};

// Mean and difference of one channel, or of luma (channel 3).
void split(const Cuts& cuts, int channel, ImageF1& mean, ImageF1& difference) {
    for (int y = 0; y < kOuter; ++y) {
        for (int x = 0; x < kOuter; ++x) {
            const float* p = cuts.current.pixel(x, y);
            const float* q = cuts.previous.pixel(x, y);
            const float a = channel < 3 ? p[channel] : luma_601(p);
            const float b = channel < 3 ? q[channel] : luma_601(q);
            mean.row(y)[x] = 0.5f * (a + b);
            difference.row(y)[x] = a - b;
        }
    }
}

// A pixel less its binomial 3×3 mean.
float detail_at(const ImageF3& p, int x, int y, int c) {
    const auto at = [&](int u, int v) { return p.pixel(x + u, y + v)[c]; };
    const float near = at(-1, 0) + at(1, 0) + at(0, -1) + at(0, 1);
    const float far = at(-1, -1) + at(1, -1) + at(-1, 1) + at(1, 1);
    return 0.75f * at(0, 0) - 0.125f * near - 0.0625f * far;
}

RegisteredBlock left_over(const Cuts& cuts) {
    RegisteredBlock block{ImageF3(kSide, kSide), ImageF3(kSide, kSide), ImageF3(kSide, kSide), {}};
    ImageF1 mean(kOuter, kOuter), difference(kOuter, kOuter);
    for (int c = 0; c < 3; ++c) {
        split(cuts, c, mean, difference);
        const float middle = mean_of(mean);
        const Terms fit = fitted(mean, middle, difference);
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                const Terms t = terms_at(mean, middle, x + 1, y + 1);
                float explained = 0;
                for (std::size_t k = 0; k < kTerms; ++k)
                    explained += fit[k] * t[k];
                block.residual.pixel(x, y)[c] = difference.row(y + 1)[x + 1] - explained;
                block.mean.pixel(x, y)[c] = mean.row(y + 1)[x + 1];
                block.detail.pixel(x, y)[c] = detail_at(cuts.current, x + 1, y + 1, c) *
                                              detail_at(cuts.previous, x + 1, y + 1, c);
            }
        }
    }
    return block;
}

}  // namespace

BlockPair::BlockPair(ViewF3 cur, ViewF3 prev, ViewU8x1 cur_visible, ViewU8x1 prev_visible)
    : current(cur),
      previous(prev),
      visible(cur_visible),
      previous_visible(prev_visible),
      luma(luma_picture(cur)),
      previous_luma(luma_picture(prev)),
      small_luma(halved(luma)),
      small_previous_luma(halved(previous_luma)) {}

std::optional<RegisteredBlock> register_block(const BlockPair& pair, Vec2i corner,
                                              std::array<float, 2> start) {
    const Vec2i outer{corner.x - RegisteredBlock::kBorder, corner.y - RegisteredBlock::kBorder};
    if (!wholly_visible(pair.visible,
                        {outer.x - 1, outer.y - 1, outer.x + kOuter + 2, outer.y + kOuter + 2}))
        return std::nullopt;
    const auto rounded = [](float v) { return static_cast<int>(std::floor(v + 0.5f)); };
    const Vec2i coarse = best_place(
        pair.small_luma, {outer.x / 2, outer.y / 2}, pair.small_previous_luma, kOuter / 2,
        kSearchReach, {Vec2i{0, 0}, Vec2i{rounded(0.5f * start[0]), rounded(0.5f * start[1])}});
    const Vec2i twice{2 * coarse.x, 2 * coarse.y};
    Vec2i whole = best_place(pair.luma, outer, pair.previous_luma, kOuter, 2, {twice, twice});

    // Gauss-Newton (Lucas & Kanade 1981) from there.
    std::array<float, 2> part{};
    Cuts cuts;
    ImageF1 mean(kOuter, kOuter), difference(kOuter, kOuter);
    for (int round = 0; round < kRounds; ++round) {
        if (!cuts.take(pair, outer, whole, part)) return std::nullopt;
        split(cuts, 3, mean, difference);
        const Terms fit = fitted(mean, mean_of(mean), difference);
        if (!std::isfinite(fit[0] + fit[1])) return std::nullopt;
        for (std::size_t k = 0; k < 2; ++k) {
            part[k] += std::clamp(fit[k], -kLongestStep, kLongestStep);
            const int more = rounded(part[k]);
            part[k] -= static_cast<float>(more);
            (k == 0 ? whole.x : whole.y) += more;
        }
    }
    if (!cuts.take(pair, outer, whole, part)) return std::nullopt;
    RegisteredBlock block = left_over(cuts);
    block.lookup = {lags_of(0.5f * part[0]), lags_of(0.5f * part[1])};
    return block;
}

}  // namespace weft

#include "engine/metrics/drift.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/metrics/local_mean.h"
#include "engine/metrics/region.h"

namespace weft {
namespace {

constexpr int kRadius = 15;
constexpr float kSigmaPx = 6.0f;
constexpr int kLevels = 3;
constexpr int kIterations = 20;
constexpr double kSettledPx = 0.002;
constexpr double kLeastCorrelation = 0.5;
// The smaller eigenvalue of the mean structure tensor, of values around 1: a contrast of about 1 %
// per pixel in every direction.
constexpr double kLeastTexture = 1e-4;

struct Level {
    ImageF1 expected, seen;
    Matte inside;
};

Level halved(const Level& l) {
    Level out;
    const Size s{l.inside.width() / 2, l.inside.height() / 2};
    out.expected = ImageF1(s);
    out.seen = ImageF1(s);
    out.inside = Matte(s);
    for (int y = 0; y < s.height; ++y) {
        for (int x = 0; x < s.width; ++x) {
            float e = 0;
            float n = 0;
            int count = 0;
            for (int k = 0; k < 4; ++k) {
                const int u = 2 * x + k % 2;
                const int v = 2 * y + k / 2;
                if (l.inside.at(u, v) == 0) continue;
                e += l.expected.at(u, v);
                n += l.seen.at(u, v);
                ++count;
            }
            if (count < 3) continue;
            out.expected.at(x, y) = e / static_cast<float>(count);
            out.seen.at(x, y) = n / static_cast<float>(count);
            out.inside.at(x, y) = 255;
        }
    }
    return out;
}

// Bilinear; false when one of the four pixels is not inside.
bool read(const ImageF1& image, const Matte& inside, double x, double y, double& value) {
    if (!(x >= 0 && y >= 0 && x < image.width() - 1 && y < image.height() - 1)) return false;
    const int ix = static_cast<int>(x);
    const int iy = static_cast<int>(y);
    if (inside.at(ix, iy) == 0 || inside.at(ix + 1, iy) == 0 || inside.at(ix, iy + 1) == 0 ||
        inside.at(ix + 1, iy + 1) == 0)
        return false;
    const double fx = x - ix;
    const double fy = y - iy;
    const double top = (1 - fx) * static_cast<double>(image.at(ix, iy)) +
                       fx * static_cast<double>(image.at(ix + 1, iy));
    const double bottom = (1 - fx) * static_cast<double>(image.at(ix, iy + 1)) +
                          fx * static_cast<double>(image.at(ix + 1, iy + 1));
    value = (1 - fy) * top + fy * bottom;
    return true;
}

// Weighted moments of one window for one trial displacement (dx, dy).
struct Window {
    double weight = 0, full = 0;
    double gxx = 0, gxy = 0, gyy = 0, bx = 0, by = 0;
    double se = 0, sn = 0, see = 0, snn = 0, sen = 0, sgx = 0, sgy = 0;
    [[nodiscard]] double correlation() const {
        const double e = see - se * se / weight;
        const double n = snn - sn * sn / weight;
        return e > 0 && n > 0 ? (sen - se * sn / weight) / std::sqrt(e * n) : 0;
    }
    [[nodiscard]] double texture() const {
        const double half = 0.5 * (gxx + gyy);
        return (half - std::sqrt(std::max(0.0, half * half - (gxx * gyy - gxy * gxy)))) / weight;
    }
};

Window window_at(const Level& l, int cx, int cy, double dx, double dy) {
    static const std::array<double, 2 * kRadius + 1> kGauss = [] {
        std::array<double, 2 * kRadius + 1> g{};
        for (int i = -kRadius; i <= kRadius; ++i) {
            const double t = i / static_cast<double>(kSigmaPx);
            g[static_cast<std::size_t>(i + kRadius)] = std::exp(-0.5 * t * t);
        }
        return g;
    }();
    Window w;
    for (int j = -kRadius; j <= kRadius; ++j) {
        for (int i = -kRadius; i <= kRadius; ++i) {
            const double k = kGauss[static_cast<std::size_t>(i + kRadius)] *
                             kGauss[static_cast<std::size_t>(j + kRadius)];
            w.full += k;
            const int x = cx + i;
            const int y = cy + j;
            if (x < 0 || y < 0 || x >= l.inside.width() || y >= l.inside.height() ||
                l.inside.at(x, y) == 0)
                continue;
            // Gradient of the seen picture at the displaced place, by central differences there.
            const double u = x + dx;
            const double v = y + dy;
            double n = 0;
            double left = 0;
            double right = 0;
            double up = 0;
            double down = 0;
            if (!read(l.seen, l.inside, u, v, n) || !read(l.seen, l.inside, u - 1, v, left) ||
                !read(l.seen, l.inside, u + 1, v, right) || !read(l.seen, l.inside, u, v - 1, up) ||
                !read(l.seen, l.inside, u, v + 1, down))
                continue;
            const double e = static_cast<double>(l.expected.at(x, y));
            const double gx = 0.5 * (right - left);
            const double gy = 0.5 * (down - up);
            w.weight += k;
            w.gxx += k * gx * gx;
            w.gxy += k * gx * gy;
            w.gyy += k * gy * gy;
            w.bx += k * gx * (e - n);
            w.by += k * gy * (e - n);
            w.sgx += k * gx;
            w.sgy += k * gy;
            w.se += k * e;
            w.sn += k * n;
            w.see += k * e * e;
            w.snn += k * n * n;
            w.sen += k * e * n;
        }
    }
    return w;
}

enum class Found { kNo, kNoTexture, kYes };

// Gauss–Newton for the displacement of one window. The windows' mean difference is removed, so that
// a constant change of brightness has no effect. dx, dy: the start and the result.
Found track(const Level& l, int cx, int cy, double& dx, double& dy) {
    for (int i = 0; i < kIterations; ++i) {
        const Window w = window_at(l, cx, cy, dx, dy);
        if (w.weight < 0.5 * w.full || w.texture() < kLeastTexture) return Found::kNoTexture;
        const double offset = (w.se - w.sn) / w.weight;
        const double bx = w.bx - offset * w.sgx;
        const double by = w.by - offset * w.sgy;
        const double det = w.gxx * w.gyy - w.gxy * w.gxy;
        const double sx = (w.gyy * bx - w.gxy * by) / det;
        const double sy = (w.gxx * by - w.gxy * bx) / det;
        const double length = std::hypot(sx, sy);
        const double limit = length > 2.0 ? 2.0 / length : 1.0;
        dx += limit * sx;
        dy += limit * sy;
        if (length < kSettledPx) break;
    }
    const Window w = window_at(l, cx, cy, dx, dy);
    if (w.weight < 0.5 * w.full) return Found::kNoTexture;
    return w.correlation() >= kLeastCorrelation ? Found::kYes : Found::kNo;
}

struct Patch {
    Found found = Found::kNoTexture;
    double dx = 0, dy = 0;
};

Patch follow_patch(const std::vector<Level>& pyramid, int x, int y) {
    Patch p;
    for (int level = kLevels - 1; level >= 0; --level) {
        const Level& l = pyramid[static_cast<std::size_t>(level)];
        double dx = p.dx;
        double dy = p.dy;
        const Found found = track(l, x >> level, y >> level, dx, dy);
        if (level == 0) {
            p.found = found;
            p.dx = dx;
            p.dy = dy;
        } else {
            // A coarse level that fails leaves the start unchanged.
            if (found == Found::kYes) {
                p.dx = dx;
                p.dy = dy;
            }
            p.dx *= 2;
            p.dy *= 2;
        }
    }
    return p;
}

}  // namespace

ResidualMotion residual_motion(ViewF1 expected_luma, ViewF1 seen_luma, ViewU8x1 region,
                               int step_px) {
    std::vector<Level> pyramid(1);
    pyramid[0].inside = inside_and_finite(inside_and_finite(region, expected_luma), seen_luma);
    pyramid[0].expected = divided_by_local_mean(expected_luma, pyramid[0].inside);
    pyramid[0].seen = divided_by_local_mean(seen_luma, pyramid[0].inside);
    while (pyramid.size() < kLevels)
        pyramid.push_back(halved(pyramid.back()));

    const int nx = region.width() / step_px;
    const int ny = region.height() / step_px;
    std::vector<Patch> patches(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
    parallel_for(static_cast<std::size_t>(ny), [&](std::size_t j) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(nx); ++i) {
            const int x = static_cast<int>(i) * step_px + step_px / 2;
            const int y = static_cast<int>(j) * step_px + step_px / 2;
            if (pyramid[0].inside.at(x, y) != 0)
                patches[j * static_cast<std::size_t>(nx) + i] = follow_patch(pyramid, x, y);
        }
    });
    RowSum length;
    RowSum along_x;
    RowSum along_y;
    ResidualMotion out;
    for (const Patch& p : patches) {
        if (p.found == Found::kNo) ++out.lost;
        if (p.found != Found::kYes) continue;
        length.add(std::hypot(p.dx, p.dy));
        along_x.add(p.dx);
        along_y.add(p.dy);
    }
    out.patches = length.count;
    out.mean_px = length.mean();
    out.mean_x_px = along_x.mean();
    out.mean_y_px = along_y.mean();
    return out;
}

}  // namespace weft

#include "engine/metrics/form_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace weft {
namespace {

constexpr int kMarginPx = 4, kRingPx = 12;
constexpr double kLeastCosine = 0.15;
constexpr double kFoldCosine = 0.9;  // between the normals on either side of a pixel
constexpr double kMostUneven = 2;    // of two steps side by side: more is another sheet
constexpr double kTearTexels = 1;
constexpr std::int64_t kLeastPixels = 200;
constexpr double kShownShare = 0.6;  // of the largest area
constexpr double kTiny = 1e-30;

using Point3 = std::array<double, 3>;
using TexelStep = std::array<double, 2>;

double dot(const Point3& a, const Point3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Point3 cross(const Point3& a, const Point3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// How far each pixel lies from what the matte does not cover whole, squared and up to `reach`
// squared + 1; the picture's border is no edge.
Image<int, 1> squared_depth(ViewU8x1 matte, int reach) {
    const int width = matte.width(), height = matte.height(), far = reach + 1;
    Image<int, 1> along(matte.size()), out(matte.size(), reach * reach + 1);
    for (int y = 0; y < height; ++y) {
        int* row = along.row(y);
        for (int x = 0, since = far; x < width; ++x) {
            since = matte.row(y)[x] == 255 ? std::min(since + 1, far) : 0;
            row[x] = since;
        }
        for (int x = width - 1, since = far; x >= 0; --x) {
            since = row[x] == 0 ? 0 : std::min(since + 1, far);
            row[x] = std::min(row[x], since);
        }
    }
    for (int y = 0; y < height; ++y) {
        for (int v = std::max(0, y - reach); v <= std::min(height - 1, y + reach); ++v) {
            const int down = (v - y) * (v - y);
            for (int x = 0; x < width; ++x) {
                const int d = along.row(v)[x];
                out.row(y)[x] = std::min(out.row(y)[x], d * d + down);
            }
        }
    }
    return out;
}

// The pass, the coordinates and what they say at a pixel. Directions: (1, 0) and (0, 1).
class Pixels {
  public:
    Pixels(ViewF3 positions, ViewF2 st, ViewF3 normals, Size plane)
        : positions_(positions), st_(st), normals_(normals) {
        texels_ = {static_cast<double>(plane.width), static_cast<double>(plane.height)};
    }

    // Between two pixels; x right and y down.
    [[nodiscard]] TexelStep texels(int x0, int y0, int x1, int y1) const {
        TexelStep out{};
        for (std::size_t c = 0; c < 2; ++c) {
            double d = static_cast<double>(st_.pixel(x1, y1)[c]) - st_.pixel(x0, y0)[c];
            d -= std::round(d);
            out[c] = (c == 0 ? d : -d) * texels_[c];
        }
        return out;
    }

    [[nodiscard]] Point3 metres(int x0, int y0, int x1, int y1) const {
        Point3 out{};
        for (std::size_t c = 0; c < 3; ++c)
            out[c] = static_cast<double>(positions_.pixel(x1, y1)[c]) - positions_.pixel(x0, y0)[c];
        return out;
    }

    // Not finite where a neighbour has no place; one-sided at the picture's border.
    [[nodiscard]] Point3 normal(int x, int y) const {
        if (!normals_.empty()) {
            const float* n = normals_.pixel(x, y);
            return {n[0], n[1], n[2]};
        }
        const int left = std::max(x - 1, 0), right = std::min(x + 1, positions_.width() - 1);
        const int top = std::max(y - 1, 0), bottom = std::min(y + 1, positions_.height() - 1);
        Point3 n = cross(metres(left, y, right, y), metres(x, top, x, bottom));
        const double length = std::sqrt(dot(n, n));
        for (double& v : n)
            v /= length;
        return n;
    }

    // Whether the same sheet goes on without a fold: false where a place is not known.
    [[nodiscard]] bool smooth(int x, int y, int dx, int dy) const {
        const Point3 before = metres(x - dx, y - dy, x, y), after = metres(x, y, x + dx, y + dy);
        const double a = dot(before, before), b = dot(after, after);
        if (!(std::max(a, b) <= kMostUneven * kMostUneven * std::min(a, b))) return false;
        return dot(normal(x - dx, y - dy), normal(x + dx, y + dy)) > kFoldCosine;
    }

    [[nodiscard]] bool torn(int x, int y, int dx, int dy) const {
        const Point3 before = metres(x - dx, y - dy, x, y), after = metres(x, y, x + dx, y + dy);
        const double ratio = std::sqrt(dot(after, after) / dot(before, before));
        const TexelStep first = texels(x - dx, y - dy, x, y), second = texels(x, y, x + dx, y + dy);
        return std::hypot(second[0] - first[0] * ratio, second[1] - first[1] * ratio) > kTearTexels;
    }

  private:
    ViewF3 positions_;
    ViewF2 st_;
    ViewF3 normals_;
    TexelStep texels_{};
};

// aᵀa of the steps along x and y.
struct Metric {
    double xx = 0, xy = 0, yy = 0;
    [[nodiscard]] double determinant() const { return xx * yy - xy * xy; }
};

struct Eigenvalues {
    double larger = 0, smaller = 0;
};

// Of below⁻¹ above.
Eigenvalues eigenvalues(const Metric& above, const Metric& below) {
    const double area = below.determinant();
    const double half =
        (below.yy * above.xx - 2 * below.xy * above.xy + below.xx * above.yy) / (2 * area);
    const double product = std::max(above.determinant() / area, 0.0);
    const double larger = half + std::sqrt(std::max(half * half - product, 0.0));
    return {larger, product / std::max(larger, kTiny)};
}

// The metric of a pixel's directions, up to a factor: (a, b, 1) is the ray.
Metric ray_metric(double a, double b) {
    const double square = 1 + a * a + b * b;
    return {1 - a * a / square, -a * b / square, 1 - b * b / square};
}

// With P = r e along the ray e of unit length, the metric is r² that of e, plus ∇r ∇rᵀ; so of the
// one by the other the eigenvalues are r² and r² over the cosine's square.
double cosine(const Metric& surface, int x, int y, Size picture, std::optional<double> focal_px) {
    Metric rays{1, 0, 1};  // from far away
    if (focal_px) {
        rays = ray_metric((x + 0.5 - 0.5 * picture.width) / *focal_px,
                          (y + 0.5 - 0.5 * picture.height) / *focal_px);
    }
    const auto [larger, smaller] = eigenvalues(surface, rays);
    return std::sqrt(smaller / larger);
}

struct Laid {
    double log_stretch = 0, log_area = 0;
};

Laid laid(const Metric& texture, const Metric& surface) {
    const auto [larger, smaller] = eigenvalues(texture, surface);
    constexpr double kMostStretched = 1e-12;
    const double least = std::max(smaller, kMostStretched * std::max(larger, kTiny));
    return {0.5 * std::log(std::max(larger, least) / least),
            0.5 * std::log(std::max(larger * smaller, kTiny))};
}

double quantile(std::vector<double>& values, double share) {
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

std::optional<MedianAnd90> stretch_of(const ValueCounts& logs) {
    if (logs.count() < kLeastPixels) return std::nullopt;
    return MedianAnd90{std::exp(logs.quantile(0.5)), std::exp(logs.quantile(0.9))};
}

std::optional<MedianAnd90> area_of(const ValueCounts& logs, double middle) {
    if (logs.count() < kLeastPixels) return std::nullopt;
    return MedianAnd90{100 * logs.distance_quantile(middle, 0.5),
                       100 * logs.distance_quantile(middle, 0.9)};
}

std::optional<double> share(std::int64_t some, std::int64_t all) {
    if (all == 0) return std::nullopt;
    return static_cast<double>(some) / static_cast<double>(all);
}

double covered(ViewU8x1 matte) {
    double sum = 0;
    for (int y = 0; y < matte.height(); ++y)
        for (int x = 0; x < matte.width(); ++x)
            sum += matte.row(y)[x];
    return sum / 255;
}

}  // namespace

FormTruth::FormTruth(Size plane, std::optional<double> focal_px)
    : plane_(plane), focal_px_(focal_px) {}

FormTruth::Seen FormTruth::add(int frame, ViewF3 positions, ViewF2 st, ViewU8x1 matte,
                               ViewF3 normals) {
    const Image<int, 1> depth = squared_depth(matte, kRingPx);
    const Pixels pixels(positions, st, normals, plane_);
    Seen seen;
    std::vector<double> stretches, areas;
    std::int64_t flipped = 0;
    for (int y = 1; y < matte.height() - 1; ++y) {
        for (int x = 1; x < matte.width() - 1; ++x) {
            if (depth.at(x, y) <= kMarginPx * kMarginPx) continue;
            ++seen.inside;
            const Point3 px = pixels.metres(x - 1, y, x + 1, y),
                         py = pixels.metres(x, y - 1, x, y + 1);
            const Metric surface{dot(px, px), dot(px, py), dot(py, py)};
            if (!(surface.determinant() > 0)) continue;
            ++seen.placed;
            const TexelStep tx = pixels.texels(x - 1, y, x + 1, y),
                            ty = pixels.texels(x, y - 1, x, y + 1);
            const Metric texture{tx[0] * tx[0] + tx[1] * tx[1], tx[0] * ty[0] + tx[1] * ty[1],
                                 ty[0] * ty[0] + ty[1] * ty[1]};
            if (!std::isfinite(texture.xx + texture.yy)) continue;
            seen.laid += texture.xx + texture.yy > 0 ? 1 : 0;
            if (cosine(surface, x, y, matte.size(), focal_px_) < kLeastCosine ||
                !pixels.smooth(x, y, 1, 0) || !pixels.smooth(x, y, 0, 1))
                continue;
            const Laid here = laid(texture, surface);
            stretches.push_back(here.log_stretch), areas.push_back(here.log_area);
            stretch_.add(here.log_stretch), log_area_.add(here.log_area);
            if (depth.at(x, y) <= kRingPx * kRingPx)
                rim_stretch_.add(here.log_stretch), rim_log_area_.add(here.log_area);
            flipped += tx[0] * ty[1] - tx[1] * ty[0] > 0 ? 0 : 1;
            torn_ += pixels.torn(x, y, 1, 0) || pixels.torn(x, y, 0, 1) ? 1 : 0;
        }
    }
    flipped_ += flipped;
    Frame out{{frame, static_cast<std::int64_t>(areas.size()), {}, {}, {}}, covered(matte), 0};
    out.measured.flipped_share = share(flipped, out.measured.pixels);
    if (out.measured.pixels >= kLeastPixels) {
        out.measured.stretch =
            MedianAnd90{std::exp(quantile(stretches, 0.5)), std::exp(quantile(stretches, 0.9))};
        out.log_area = quantile(areas, 0.5);
    }
    frames_.push_back(out);
    return seen;
}

const FormTruth::Frame* FormTruth::base_frame(int reference) const {
    double largest = 0;
    for (const Frame& f : frames_)
        largest = std::max(largest, f.area_px);
    const auto enough = [](const Frame& f) { return f.measured.pixels >= kLeastPixels; };
    const Frame* shown = nullptr;
    for (const Frame& f : frames_) {
        if (f.measured.frame == reference && enough(f)) return &f;
        if (!shown && f.area_px >= kShownShare * largest) shown = &f;
    }
    return shown && enough(*shown) ? shown : nullptr;
}

FormMeasures FormTruth::summary(int reference) const {
    FormMeasures out;
    const Frame* base = base_frame(reference);
    for (const Frame& f : frames_) {
        out.frames.push_back(f.measured);
        out.pixels += f.measured.pixels;
        if (base && f.measured.stretch)
            out.frames.back().area_shift_percent = 100 * (f.log_area - base->log_area);
    }
    if (!base) return out;
    out.base_frame = base->measured.frame;
    out.stretch = stretch_of(stretch_), out.rim_stretch = stretch_of(rim_stretch_);
    out.area_percent = area_of(log_area_, base->log_area);
    out.rim_area_percent = area_of(rim_log_area_, base->log_area);
    out.flipped_share = share(flipped_, out.pixels), out.torn_share = share(torn_, out.pixels);
    return out;
}

}  // namespace weft

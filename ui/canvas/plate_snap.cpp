#include "ui/canvas/plate_snap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/core/image.h"

namespace weft::ui {
namespace {

constexpr float kMostReach = 32;
// Display codes (of 255) per pixel: weaker gradients are texture and grain.
constexpr float kLeastGradient = 7;
// An edge counts beside the strongest one in reach where it has so much of its gradient.
constexpr float kShareOfStrongest = 0.4f;

Vec2 clamped(const Picture& picture, float x, float y) {
    return {std::clamp(x, 0.0f, static_cast<float>(picture.size.width - 1)),
            std::clamp(y, 0.0f, static_cast<float>(picture.size.height - 1))};
}

float luma(const Picture& picture, int x, int y) {
    const Vec2 in = clamped(picture, static_cast<float>(x), static_cast<float>(y));
    const Vec3 v = picture.at(static_cast<int>(in.x), static_cast<int>(in.y));
    return 255 * (0.2126f * v.x + 0.7152f * v.y + 0.0722f * v.z);
}

// Gradients of a part of a picture, of brightness smoothed by 1 2 1.
class Gradients {
  public:
    Gradients(const Picture& picture, const Recti& part) : part_(part), of_(part.size()) {
        const Recti wide = part.grown(2);
        ImageF1 light(wide.size()), smooth(wide.size());
        for (int y = 0; y < wide.height(); ++y)
            for (int x = 0; x < wide.width(); ++x)
                light.at(x, y) = luma(picture, wide.x0 + x, wide.y0 + y);
        for (int y = 1; y + 1 < wide.height(); ++y)
            for (int x = 1; x + 1 < wide.width(); ++x) {
                float sum = 0;
                for (int j = -1; j <= 1; ++j)
                    for (int i = -1; i <= 1; ++i)
                        sum += static_cast<float>((2 - std::abs(i)) * (2 - std::abs(j))) *
                               light.at(x + i, y + j);
                smooth.at(x, y) = sum / 16;
            }
        for (int y = 0; y < part.height(); ++y)
            for (int x = 0; x < part.width(); ++x) {
                of_.pixel(x, y)[0] = 0.5f * (smooth.at(x + 3, y + 2) - smooth.at(x + 1, y + 2));
                of_.pixel(x, y)[1] = 0.5f * (smooth.at(x + 2, y + 3) - smooth.at(x + 2, y + 1));
            }
    }
    // At a pixel of the part; the border's beyond.
    [[nodiscard]] Vec2 at(int x, int y) const {
        const float* g = of_.pixel(std::clamp(x - part_.x0, 0, of_.width() - 1),
                                   std::clamp(y - part_.y0, 0, of_.height() - 1));
        return {g[0], g[1]};
    }
    // Between pixel centres.
    [[nodiscard]] Vec2 between(Vec2 p) const {
        const float x = std::floor(p.x - 0.5f), y = std::floor(p.y - 0.5f);
        const float u = p.x - 0.5f - x, v = p.y - 0.5f - y;
        const int i = static_cast<int>(x), j = static_cast<int>(y);
        return (1 - v) * ((1 - u) * at(i, j) + u * at(i + 1, j)) +
               v * ((1 - u) * at(i, j + 1) + u * at(i + 1, j + 1));
    }
    [[nodiscard]] const Recti& part() const { return part_; }

  private:
    Recti part_;
    ImageF2 of_;
};

float length(Vec2 v) {
    return std::sqrt(v.x * v.x + v.y * v.y);
}

Recti around(Vec2 low, Vec2 high, float margin) {
    return {
        static_cast<int>(std::floor(low.x - margin)), static_cast<int>(std::floor(low.y - margin)),
        static_cast<int>(std::ceil(high.x + margin)), static_cast<int>(std::ceil(high.y + margin))};
}

// The peak of three values a step apart, from the middle one, by a parabola.
float peak(float before, float here, float after) {
    const float bend = before - 2 * here + after;
    if (bend >= 0) return 0;
    return std::clamp(0.5f * (before - after) / bend, -0.5f, 0.5f);
}

// Where the edges of a neighbourhood meet: the place that is nearest to all of them (Förstner and
// Gülch 1987). Nothing where they run in one direction.
std::optional<Vec2> meeting_of(const Gradients& gradients, int x, int y) {
    constexpr int kReach = 3;
    float a = 0, b = 0, d = 0, u = 0, v = 0;
    for (int j = -kReach; j <= kReach; ++j) {
        for (int i = -kReach; i <= kReach; ++i) {
            const Vec2 g = gradients.at(x + i, y + j);
            const Vec2 p(static_cast<float>(i), static_cast<float>(j));
            a += g.x * g.x;
            b += g.x * g.y;
            d += g.y * g.y;
            u += g.x * (g.x * p.x + g.y * p.y);
            v += g.y * (g.x * p.x + g.y * p.y);
        }
    }
    const float half = 0.5f * (a + d);
    const float apart = std::sqrt(std::max(0.0f, half * half - (a * d - b * b)));
    const float least = half - apart, most = half + apart;
    // The weaker of two edges still has this share of the stronger one's power.
    constexpr float kShareOfPower = 0.18f;
    constexpr float kPixels = 4;  // of a strong gradient, along the weaker edge
    if (least < kShareOfPower * most || least < kPixels * kLeastGradient * kLeastGradient)
        return std::nullopt;
    const float det = a * d - b * b;
    const Vec2 at((d * u - b * v) / det, (a * v - b * u) / det);
    if (std::abs(at.x) > 1.5f || std::abs(at.y) > 1.5f) return std::nullopt;
    return Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) + at;
}

// An offset from a line that is to be fitted, at a place along it.
struct Sighting {
    float along = 0, off = 0;
};

float luma_between(const Picture& picture, Vec2 p) {
    const float x = std::floor(p.x - 0.5f), y = std::floor(p.y - 0.5f);
    const float u = p.x - 0.5f - x, v = p.y - 0.5f - y;
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    return (1 - v) * ((1 - u) * luma(picture, i, j) + u * luma(picture, i + 1, j)) +
           v * ((1 - u) * luma(picture, i, j + 1) + u * luma(picture, i + 1, j + 1));
}

// Strong edges across a line through `at`, by their offsets along its normal; the nearest ones.
std::vector<float> edges_across(const Picture& picture, Vec2 at, Vec2 unit, int steps) {
    const Vec2 normal(-unit.y, unit.x);
    std::vector<float> light;
    for (int step = -steps - 3; step <= steps + 3; ++step) {
        float sum = 0;
        for (const float aside : {-1.0f, 0.0f, 1.0f})
            sum += luma_between(picture, at + normal * static_cast<float>(step) + unit * aside);
        light.push_back(sum / 3);
    }
    std::vector<float> gradient(light.size(), 0.0f);  // of the light smoothed by 1 2 1
    for (std::size_t k = 2; k + 2 < light.size(); ++k)
        gradient[k] =
            std::abs(light[k + 2] + 2 * light[k + 1] - 2 * light[k - 1] - light[k - 2]) / 8;
    std::vector<float> out;
    for (std::size_t k = 3; k + 3 < light.size(); ++k) {
        const float here = gradient[k];
        if (here < kLeastGradient || here < gradient[k - 1] || here <= gradient[k + 1]) continue;
        out.push_back(static_cast<float>(static_cast<int>(k) - steps - 3) +
                      peak(gradient[k - 1], here, gradient[k + 1]));
    }
    std::sort(out.begin(), out.end(), [](float x, float y) {
        return std::abs(x) != std::abs(y) ? std::abs(x) < std::abs(y) : x < y;
    });
    constexpr std::size_t kMost = 4;
    out.resize(std::min(out.size(), kMost));
    return out;
}

struct Line {
    float off = 0, slope = 0;  // at the start, and per pixel along
};

// Those of the edges that lie on a line.
std::vector<Sighting> on_line(const std::vector<std::vector<float>>& edges, float step,
                              const Line& line, float within) {
    std::vector<Sighting> out;
    for (std::size_t k = 0; k < edges.size(); ++k) {
        const float along = (static_cast<float>(k) + 0.5f) * step;
        const float wanted = line.off + line.slope * along;
        std::optional<float> best;
        for (const float off : edges[k])
            if (std::abs(off - wanted) <= within &&
                (!best || std::abs(off - wanted) < std::abs(*best - wanted)))
                best = off;
        if (best) out.push_back({along, *best});
    }
    return out;
}

Line fitted_line(const std::vector<Sighting>& seen) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const Sighting& s : seen) {
        const auto a = static_cast<double>(s.along), o = static_cast<double>(s.off);
        n += 1;
        x += a;
        y += o;
        xx += a * a;
        xy += a * o;
    }
    const double det = n * xx - x * x;
    const double slope = det > 0 ? (n * xy - x * y) / det : 0;
    return {static_cast<float>((y - slope * x) / n), static_cast<float>(slope)};
}

// The line with the most edges on it, of all through one of the first and one of the last ones.
std::pair<Line, std::size_t> best_line(const std::vector<std::vector<float>>& edges, float step,
                                       float within) {
    std::pair<Line, std::size_t> best;
    float nearest = 0;
    const std::size_t third = std::max<std::size_t>(1, edges.size() / 3);
    const std::size_t stride = std::max<std::size_t>(1, third / 7);
    for (std::size_t i = 0; i < third; i += stride) {
        for (std::size_t j = edges.size() - third; j < edges.size(); j += stride) {
            for (const float a : edges[i]) {
                for (const float b : edges[j]) {
                    Line line;
                    line.slope = (b - a) / (static_cast<float>(j - i) * step);
                    line.off = a - line.slope * (static_cast<float>(i) + 0.5f) * step;
                    const std::size_t count = on_line(edges, step, line, within).size();
                    const float distance = std::abs(a) + std::abs(b);
                    if (count < best.second || (count == best.second && distance >= nearest))
                        continue;
                    best = {line, count};
                    nearest = distance;
                }
            }
        }
    }
    return best;
}

}  // namespace

std::optional<SnapPlace> snapped_to_edge(const Picture& picture, Vec2 at, float reach_px) {
    if (picture.size.empty()) return std::nullopt;
    const float reach = std::clamp(reach_px, 1.5f, kMostReach);
    const Gradients gradients(picture, around(at, at, reach + 4));
    const Recti& part = gradients.part();
    std::optional<SnapPlace> edge, corner;
    float edge_off = reach, corner_off = reach, strongest = kLeastGradient;
    for (int y = part.y0 + 4; y < part.y1 - 4; ++y)
        for (int x = part.x0 + 4; x < part.x1 - 4; ++x)
            strongest = std::max(strongest, length(gradients.at(x, y)));
    const float least = std::max(kLeastGradient, kShareOfStrongest * strongest);
    for (int y = part.y0 + 4; y < part.y1 - 4; ++y) {
        for (int x = part.x0 + 4; x < part.x1 - 4; ++x) {
            const Vec2 g = gradients.at(x, y);
            const float here = length(g);
            if (here < least) continue;
            const Vec2 centre(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            if (const auto meeting = meeting_of(gradients, x, y)) {
                const float off = length(*meeting - at);
                if (off < corner_off) {
                    corner_off = off;
                    corner = SnapPlace{*meeting, true};
                }
            }
            const Vec2 across = g / here;
            const float before = length(gradients.between(centre - across));
            const float after = length(gradients.between(centre + across));
            if (here < before || here <= after) continue;
            // The point of this piece of the edge that is nearest, at most half a pixel along.
            const Vec2 on = centre + across * peak(before, here, after), along(-across.y, across.x);
            const Vec2 d = at - on;
            const Vec2 near = on + along * std::clamp(d.x * along.x + d.y * along.y, -0.7f, 0.7f);
            const float off = length(near - at);
            if (off < edge_off) {
                edge_off = off;
                edge = SnapPlace{near, false};
            }
        }
    }
    return corner ? corner : edge;
}

std::optional<std::pair<Vec2, Vec2>> snapped_to_line(const Picture& picture, Vec2 from, Vec2 to,
                                                     float reach_px) {
    constexpr float kShortest = 12;
    constexpr int kMostPlaces = 64;
    constexpr float kOnLinePx = 1.25f;
    const float reach = std::clamp(reach_px, 1.5f, kMostReach);
    const float long_px = length(to - from);
    if (picture.size.empty() || long_px < kShortest) return std::nullopt;
    const Vec2 unit = (to - from) / long_px, normal(-unit.y, unit.x);
    const int places = std::min(kMostPlaces, static_cast<int>(long_px / 2));
    const float step = long_px / static_cast<float>(places);
    std::vector<std::vector<float>> edges;
    edges.reserve(static_cast<std::size_t>(places));
    for (int k = 0; k < places; ++k)
        edges.push_back(edges_across(picture, from + unit * ((static_cast<float>(k) + 0.5f) * step),
                                     unit, static_cast<int>(std::ceil(reach))));
    auto [line, count] = best_line(edges, step, kOnLinePx);
    if (count * 10 < edges.size() * 6) return std::nullopt;
    for (int round = 0; round < 3; ++round)
        line = fitted_line(on_line(edges, step, line, kOnLinePx));
    if (on_line(edges, step, line, kOnLinePx).size() * 10 < edges.size() * 6) return std::nullopt;
    const Vec2 through = from + normal * line.off;
    const Vec2 way = (unit + normal * line.slope) / std::sqrt(1 + line.slope * line.slope);
    const auto nearest = [&](Vec2 p) {
        const Vec2 d = p - through;
        return through + way * (d.x * way.x + d.y * way.y);
    };
    return std::pair{nearest(from), nearest(to)};
}

}  // namespace weft::ui

#include "app/textures/patch_pick.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/wrap.h"

namespace weft {
namespace {

constexpr std::size_t kMostTexels = 1 << 18;
constexpr std::array<Vec2i, 4> kSteps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

// The texels of a synthesized plane; coordinates wrap.
class Texels {
  public:
    explicit Texels(const PlaneMap& map) : map_(map), size_(map.source.size()) {}

    [[nodiscard]] Vec2i at(Vec2i p) const {
        return {wrapped(p.x, size_.width), wrapped(p.y, size_.height)};
    }
    [[nodiscard]] TexelRun run(Vec2i stored) const {
        const std::int32_t* from = map_.source.pixel(stored.x, stored.y);
        return {stored.x, stored.y, 1, from[0], from[1], sample(stored), orientation(stored)};
    }
    // Returns true if the neighbour of p shows the neighbouring sample pixel.
    [[nodiscard]] bool joined(Vec2i p, Vec2i step) const {
        const Vec2i a = at(p), b = at(p + step);
        if (sample(a) != sample(b) || orientation(a) != orientation(b)) return false;
        const std::int32_t *s = map_.source.pixel(a.x, a.y), *t = map_.source.pixel(b.x, b.y);
        const Vec2i moved = in_sample(step, orientation(a));
        return t[0] - s[0] == moved.x && t[1] - s[1] == moved.y;
    }

  private:
    [[nodiscard]] int sample(Vec2i p) const {
        return map_.which.empty() ? 0 : map_.which.at(p.x, p.y);
    }
    [[nodiscard]] int orientation(Vec2i p) const {
        return map_.orientation.empty() ? 0 : map_.orientation.at(p.x, p.y);
    }
    // Converts a step on the plane to a step in the sample (SampleAtlas::Page::orientation).
    static Vec2i in_sample(Vec2i step, int orientation) {
        Vec2i out = step;
        switch (orientation % 4) {
            case 1:
                out = {-step.y, step.x};
                break;
            case 2:
                out = {-step.x, -step.y};
                break;
            case 3:
                out = {step.y, -step.x};
                break;
            default:
                break;
        }
        if (orientation >= 4) out.x = -out.x;
        return out;
    }

    const PlaneMap& map_;
    Size size_;
};

std::optional<Vec2i> stored_texel(const Provenance& from, Vec2 p) {
    if (!from.plane || from.plane->source.empty()) return std::nullopt;
    const Vec2 texel = from.texel_at(p);
    if (!std::isfinite(texel.x) || !std::isfinite(texel.y) || std::abs(texel.x) > 1e8f ||
        std::abs(texel.y) > 1e8f)
        return std::nullopt;
    return Texels(*from.plane)
        .at({static_cast<int>(std::floor(texel.x)), static_cast<int>(std::floor(texel.y))});
}

// Groups texels into as few runs as possible.
PlaneAmendment runs_of(const PlaneMap& map, std::vector<Vec2i> stored) {
    std::sort(stored.begin(), stored.end(),
              [](Vec2i a, Vec2i b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
    stored.erase(std::unique(stored.begin(), stored.end()), stored.end());
    const Texels texels(map);
    PlaneAmendment out;
    for (const Vec2i p : stored) {
        const TexelRun one = texels.run(p);
        if (!out.runs.empty()) {
            TexelRun& last = out.runs.back();
            if (last.y == p.y && last.x + last.count == p.x && last.orientation == 0 &&
                texels.joined({p.x - 1, p.y}, {1, 0})) {
                ++last.count;
                continue;
            }
        }
        out.runs.push_back(one);
    }
    return out;
}

}  // namespace

std::optional<PlaneAmendment> patch_at(const Provenance& from, Vec2 plate_pixel) {
    const auto start = stored_texel(from, plate_pixel);
    if (!start) return std::nullopt;
    const Texels texels(*from.plane);
    Image<std::uint8_t, 1> seen(from.plane->source.size(), 0);
    std::vector<Vec2i> stored{*start};
    seen.at(start->x, start->y) = 1;
    for (std::size_t k = 0; k < stored.size() && stored.size() < kMostTexels; ++k) {
        for (const Vec2i step : kSteps) {
            const Vec2i next = texels.at(stored[k] + step);
            if (seen.at(next.x, next.y) || !texels.joined(stored[k], step)) continue;
            seen.at(next.x, next.y) = 1;
            stored.push_back(next);
        }
    }
    return runs_of(*from.plane, std::move(stored));
}

Image<std::int32_t, 1> number_patches(const PlaneMap& map) {
    const Texels texels(map);
    Image<std::int32_t, 1> out(map.source.size(), 0);
    std::int32_t last = 0;
    std::vector<Vec2i> open;
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            if (out.at(x, y) != 0) continue;
            out.at(x, y) = ++last;
            open.assign(1, {x, y});
            while (!open.empty()) {
                const Vec2i p = open.back();
                open.pop_back();
                for (const Vec2i step : kSteps) {
                    const Vec2i next = texels.at(p + step);
                    if (out.at(next.x, next.y) != 0 || !texels.joined(p, step)) continue;
                    out.at(next.x, next.y) = last;
                    open.push_back(next);
                }
            }
        }
    }
    return out;
}

std::optional<PlaneAmendment> seam_at(const Provenance& from, Vec2 plate_pixel, int reach) {
    const auto middle = stored_texel(from, plate_pixel);
    if (!middle) return std::nullopt;
    const Texels texels(*from.plane);
    std::vector<Vec2i> stored;
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x)
            stored.push_back(texels.at(*middle + Vec2i{x, y}));
    return runs_of(*from.plane, std::move(stored));
}

std::optional<PlaneAmendment> places_in(const Provenance& from, Vec2 a, Vec2 b) {
    if (!from.plane || from.plane->source.empty()) return std::nullopt;
    // The rectangle as a polygon on the plane; its sides follow the surface's curvature.
    const std::array<Vec2, 4> corners{a, Vec2(b.x, a.y), b, Vec2(a.x, b.y)};
    std::vector<Vec2> outline;
    constexpr int kParts = 8;
    for (std::size_t k = 0; k < 4; ++k)
        for (int i = 0; i < kParts; ++i) {
            const Vec2 p =
                corners[k] + (corners[(k + 1) % 4] - corners[k]) * (static_cast<float>(i) / kParts);
            outline.push_back(from.texel_at(p));
            if (!std::isfinite(outline.back().x) || !std::isfinite(outline.back().y))
                return std::nullopt;
        }
    Vec2 low = outline[0], high = outline[0];
    for (const Vec2 p : outline) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    constexpr float kHalf = 256;
    const Vec2 middle = (low + high) * 0.5f;
    if (std::abs(middle.x) > 1e7f || std::abs(middle.y) > 1e7f) return std::nullopt;
    const int x0 = static_cast<int>(std::floor(std::max(low.x, middle.x - kHalf)));
    const int y0 = static_cast<int>(std::floor(std::max(low.y, middle.y - kHalf)));
    const int x1 = static_cast<int>(std::ceil(std::min(high.x, middle.x + kHalf)));
    const int y1 = static_cast<int>(std::ceil(std::min(high.y, middle.y + kHalf)));
    const Texels texels(*from.plane);
    std::vector<Vec2i> stored;
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
            bool inside = false;
            for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
                const Vec2 p = outline[i], q = outline[j];
                if ((p.y > py) != (q.y > py) && px < (q.x - p.x) * (py - p.y) / (q.y - p.y) + p.x)
                    inside = !inside;
            }
            if (inside) stored.push_back(texels.at({x, y}));
        }
    }
    if (stored.empty()) return std::nullopt;
    return runs_of(*from.plane, std::move(stored));
}

std::optional<std::size_t> amendment_at(const std::vector<PlaneAmendment>& amendments,
                                        const Provenance& from, Vec2 plate_pixel) {
    const auto texel = stored_texel(from, plate_pixel);
    if (!texel) return std::nullopt;
    const Size size = from.plane->source.size();
    for (std::size_t k = amendments.size(); k-- > 0;) {
        for (const TexelRun& run : amendments[k].runs) {
            if (wrapped(run.y, size.height) != texel->y) continue;
            if (wrapped(texel->x - run.x, size.width) < run.count) return k;
        }
    }
    return std::nullopt;
}

}  // namespace weft

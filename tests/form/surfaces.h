#pragma once
// Surfaces in front of a pinhole camera, and how a texture is laid on them.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "engine/form/metric_field.h"
#include "engine/motion/lattice_field.h"

namespace weft {

constexpr Size kSize{320, 240};
constexpr float kFocal_px = 300;
constexpr int kSpacing = 8;

// The ray of a pixel from the origin; z is the depth.
inline Vec3 ray(int x, int y) {
    return {(static_cast<float>(x) + 0.5f - 160) / kFocal_px,
            (static_cast<float>(y) + 0.5f - 120) / kFocal_px, 1};
}

struct Surface {
    ImageF3 place{kSize};
    Matte matte{kSize};
};

// `hit`: the distance along the ray, or nothing.
inline Surface seen(const std::function<float(Vec3)>& hit) {
    Surface out;
    for (int y = 0; y < kSize.height; ++y) {
        for (int x = 0; x < kSize.width; ++x) {
            const Vec3 r = ray(x, y);
            const float t = hit(r);
            const bool found = t > 0;
            for (int c = 0; c < 3; ++c)
                out.place.pixel(x, y)[c] =
                    found ? t * r[c] : std::numeric_limits<float>::quiet_NaN();
            out.matte.at(x, y) = found ? 255 : 0;
        }
    }
    return out;
}

inline float sphere(Vec3 ray, Vec3 centre, float radius, Vec3 use) {
    const Vec3 r = ray * use, c = centre * use;
    const float a = r.x * r.x + r.y * r.y + r.z * r.z, b = r.x * c.x + r.y * c.y + r.z * c.z;
    const float d = b * b - a * (c.x * c.x + c.y * c.y + c.z * c.z - radius * radius);
    return d < 0 ? 0.0f : (b - std::sqrt(d)) / a;
}

struct Distortion {
    double stretch_median = 0, stretch_p90 = 0, area_p90 = 0;  // area in ln
    bool flipped = false;
};

// Of the surface's own steps, 4 px inside of its matte and where it is not seen edge-on.
inline Distortion distortion(const Surface& surface, const LatticeField& flat) {
    std::vector<double> stretch, area;
    Distortion out;
    for (int y = 6; y < kSize.height - 6; ++y) {
        for (int x = 6; x < kSize.width - 6; ++x) {
            bool inside = true;
            for (const auto& [u, v] : {std::pair{-4, 0}, {4, 0}, {0, -4}, {0, 4}, {0, 0}})
                inside = inside && surface.matte.at(x + u, y + v) == 255;
            if (!inside) continue;
            const auto place = [&](int u, int v) {
                const float* p = surface.place.pixel(x + u, y + v);
                return Vec3(p[0], p[1], p[2]);
            };
            const Vec3 px = 0.5f * (place(1, 0) - place(-1, 0));
            const Vec3 py = 0.5f * (place(0, 1) - place(0, -1));
            const auto dot = [](Vec3 a, Vec3 b) {
                return static_cast<double>(a.x) * b.x + static_cast<double>(a.y) * b.y +
                       static_cast<double>(a.z) * b.z;
            };
            const Metric g{dot(px, px), dot(px, py), dot(py, py)};
            if (facing(g) < 0.15) continue;
            const Vec2 at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            const Vec2 ux = flat.at(at + Vec2(0.5f, 0)) - flat.at(at - Vec2(0.5f, 0)) + Vec2(1, 0);
            const Vec2 uy = flat.at(at + Vec2(0, 0.5f)) - flat.at(at - Vec2(0, 0.5f)) + Vec2(0, 1);
            const double xx = ux.x * ux.x + ux.y * ux.y, xy = ux.x * uy.x + ux.y * uy.y;
            const double yy = uy.x * uy.x + uy.y * uy.y;
            const double half = (g.yy * xx - 2 * g.xy * xy + g.xx * yy) / (2 * g.determinant());
            const double determinant = (xx * yy - xy * xy) / g.determinant();
            const double root = std::sqrt(std::max(0.0, half * half - determinant));
            stretch.push_back(std::sqrt((half + root) / (half - root)));
            area.push_back(0.5 * std::log(determinant));
            out.flipped = out.flipped || ux.x * uy.y - ux.y * uy.x <= 0;
        }
    }
    const auto at = [](std::vector<double> v, double share) {
        std::sort(v.begin(), v.end());
        return v[static_cast<std::size_t>(share * static_cast<double>(v.size() - 1))];
    };
    out.stretch_median = at(stretch, 0.5);
    out.stretch_p90 = at(stretch, 0.9);
    const double middle = at(area, 0.5);
    for (double& a : area)
        a = std::abs(a - middle);
    out.area_p90 = at(area, 0.9);
    return out;
}

inline float floor_below(Vec3 r) {
    const float down = 0.35f * r.z + 0.94f * r.y;
    return down > 0.2f ? 1.5f / down : 0.0f;
}

inline LatticeField still() {
    return {kSize, kSpacing};
}

}  // namespace weft

#include "texture_db/describe/surface_role.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace weft {
namespace {

struct MaterialRoles {
    std::string_view material;
    RoleWeights roles;  // in the order of SurfaceRole
};

// By judgement: what each surface of a film set or a drawn background usually consists of.
constexpr MaterialRoles kMaterials[]{
    //             wall  ground roof  garm. coat  prop  element
    {"asphalt", {0.05f, 1.0f, 0.20f, 0.0f, 0.0f, 0.1f, 0.0f}},
    {"bark", {0.30f, 0.1f, 0.10f, 0.0f, 0.3f, 0.8f, 0.0f}},
    {"brick", {1.00f, 0.5f, 0.10f, 0.0f, 0.0f, 0.3f, 0.0f}},
    {"carpet", {0.15f, 0.6f, 0.00f, 0.8f, 0.1f, 0.2f, 0.0f}},
    {"ceramic", {0.40f, 0.3f, 0.20f, 0.0f, 0.0f, 0.9f, 0.0f}},
    {"cloud", {0.00f, 0.0f, 0.00f, 0.0f, 0.0f, 0.0f, 1.0f}},
    {"cobblestone", {0.60f, 1.0f, 0.00f, 0.0f, 0.0f, 0.2f, 0.0f}},
    {"concrete", {1.00f, 0.8f, 0.20f, 0.0f, 0.0f, 0.5f, 0.0f}},
    {"dirt", {0.20f, 1.0f, 0.00f, 0.0f, 0.0f, 0.2f, 0.0f}},
    {"fabric", {0.10f, 0.1f, 0.05f, 1.0f, 0.3f, 0.3f, 0.0f}},
    {"foliage", {0.40f, 0.6f, 0.15f, 0.1f, 0.2f, 0.3f, 0.0f}},
    {"fur", {0.00f, 0.1f, 0.00f, 0.7f, 1.0f, 0.2f, 0.0f}},
    {"glass", {0.40f, 0.1f, 0.20f, 0.0f, 0.0f, 0.8f, 0.2f}},
    {"grass", {0.10f, 1.0f, 0.15f, 0.0f, 0.1f, 0.1f, 0.0f}},
    {"gravel", {0.15f, 1.0f, 0.20f, 0.0f, 0.0f, 0.1f, 0.0f}},
    {"ice", {0.10f, 0.6f, 0.00f, 0.0f, 0.1f, 0.5f, 0.9f}},
    {"knit", {0.00f, 0.0f, 0.00f, 1.0f, 0.4f, 0.2f, 0.0f}},
    {"lava", {0.05f, 0.6f, 0.00f, 0.0f, 0.1f, 0.2f, 1.0f}},
    {"leather", {0.05f, 0.0f, 0.00f, 1.0f, 0.8f, 0.5f, 0.0f}},
    {"marble", {0.70f, 0.7f, 0.00f, 0.0f, 0.0f, 0.9f, 0.0f}},
    {"metal", {0.60f, 0.3f, 0.60f, 0.1f, 0.1f, 1.0f, 0.0f}},
    {"paper", {0.30f, 0.0f, 0.00f, 0.2f, 0.0f, 0.7f, 0.0f}},
    {"plaster", {1.00f, 0.1f, 0.05f, 0.0f, 0.0f, 0.3f, 0.0f}},
    {"roof", {0.25f, 0.0f, 1.00f, 0.0f, 0.1f, 0.1f, 0.0f}},
    {"rubber", {0.00f, 0.4f, 0.20f, 0.2f, 0.1f, 0.6f, 0.0f}},
    {"rust", {0.45f, 0.2f, 0.50f, 0.0f, 0.0f, 0.9f, 0.0f}},
    {"sand", {0.10f, 1.0f, 0.00f, 0.0f, 0.0f, 0.1f, 0.1f}},
    {"skin", {0.00f, 0.0f, 0.05f, 0.5f, 1.0f, 0.2f, 0.0f}},
    {"snow", {0.05f, 1.0f, 0.30f, 0.0f, 0.0f, 0.1f, 0.3f}},
    {"stone", {1.00f, 0.7f, 0.25f, 0.0f, 0.0f, 0.8f, 0.0f}},
    {"straw", {0.30f, 0.6f, 0.60f, 0.3f, 0.2f, 0.4f, 0.0f}},
    {"tiles", {0.70f, 0.8f, 0.40f, 0.0f, 0.0f, 0.3f, 0.0f}},
    {"wallpaper", {0.60f, 0.0f, 0.00f, 0.2f, 0.0f, 0.1f, 0.0f}},
    {"water", {0.00f, 0.6f, 0.00f, 0.0f, 0.0f, 0.1f, 1.0f}},
    {"wood", {0.80f, 0.6f, 0.40f, 0.0f, 0.0f, 1.0f, 0.0f}},
};

constexpr std::uint8_t kInside = 128;

float row_share(ViewU8x1 coverage, int y) {
    int inside = 0;
    for (int x = 0; x < coverage.width(); ++x)
        inside += coverage.at(x, y) >= kInside ? 1 : 0;
    return static_cast<float>(inside) / static_cast<float>(coverage.width());
}

float column_share(ViewU8x1 coverage, int x) {
    int inside = 0;
    for (int y = 0; y < coverage.height(); ++y)
        inside += coverage.at(x, y) >= kInside ? 1 : 0;
    return static_cast<float>(inside) / static_cast<float>(coverage.height());
}

struct Point {
    double x = 0, y = 0;
};

// Twice the signed area of a triangle.
double turn(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Convex hull of points sorted by y, then x, as its area (Andrew 1979, monotone chain).
double hull_area(const std::vector<Point>& points) {
    std::vector<Point> hull;
    const auto half = [&](auto first, auto last) {
        const std::size_t start = hull.size();
        for (; first != last; ++first) {
            while (hull.size() >= start + 2 &&
                   turn(hull[hull.size() - 2], hull.back(), *first) <= 0)
                hull.pop_back();
            hull.push_back(*first);
        }
        hull.pop_back();
    };
    half(points.begin(), points.end());
    half(points.rbegin(), points.rend());
    double twice = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Point &a = hull[i], &b = hull[(i + 1) % hull.size()];
        twice += a.x * b.y - b.x * a.y;
    }
    return std::abs(twice) / 2;
}

// The corners of each row's outermost pixels inside.
std::vector<Point> outline(ViewU8x1 coverage, double& area) {
    std::vector<Point> points;
    for (int y = 0; y < coverage.height(); ++y) {
        int first = coverage.width(), last = -1;
        for (int x = 0; x < coverage.width(); ++x) {
            if (coverage.at(x, y) < kInside) continue;
            first = std::min(first, x);
            last = x;
            area += 1;
        }
        if (last < 0) continue;
        for (const double below : {0.0, 1.0}) {
            points.push_back({static_cast<double>(first), y + below});
            points.push_back({last + 1.0, y + below});
        }
    }
    std::sort(points.begin(), points.end(),
              [](const Point& a, const Point& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
    return points;
}

}  // namespace

RoleWeights roles_of_material(std::string_view material) {
    const auto at = std::find_if(std::begin(kMaterials), std::end(kMaterials),
                                 [&](const MaterialRoles& m) { return m.material == material; });
    if (at != std::end(kMaterials)) return at->roles;
    RoleWeights unknown;
    unknown.fill(0.4f);
    return unknown;
}

RegionPlace place_of_region(ViewU8x1 coverage) {
    RegionPlace place;
    if (coverage.width() < 1 || coverage.height() < 1) return place;
    place.top = row_share(coverage, 0);
    place.bottom = row_share(coverage, coverage.height() - 1);
    place.left = column_share(coverage, 0);
    place.right = column_share(coverage, coverage.width() - 1);
    double area = 0;
    const std::vector<Point> points = outline(coverage, area);
    if (points.empty()) return place;
    place.area =
        static_cast<float>(area / (static_cast<double>(coverage.width()) * coverage.height()));
    place.solidity = static_cast<float>(area / hull_area(points));
    place.first_row = static_cast<float>(points.front().y / coverage.height());
    return place;
}

RoleWeights roles_of_place(const RegionPlace& place) {
    RoleWeights weights;
    weights.fill(1);
    const auto at = [&](SurfaceRole role) -> float& {
        return weights[static_cast<std::size_t>(role)];
    };
    const float along_bottom = std::min(place.bottom / 0.5f, 1.0f);
    const float reaches_out =
        std::min((place.top + place.left + place.right + place.bottom) / 0.6f, 1.0f);
    const float large = std::min(place.area / 0.15f, 1.0f);
    // A region along the bottom that begins below the upper third is likely ground, and so is one
    // lower down that reaches a side.
    const float sides = std::min((place.left + place.right) / 0.3f, 1.0f);
    const float low = std::clamp((place.first_row - 0.3f) / 0.25f, 0.0f, 1.0f);
    at(SurfaceRole::kGround) = 0.6f + 1.5f * low * sides * (1 - along_bottom);
    if (along_bottom > 0 && place.first_row > 0.3f)
        at(SurfaceRole::kGround) += 0.1f + 3 * along_bottom;
    at(SurfaceRole::kWall) = 0.6f + 1.2f * large + (place.first_row < 0.3f ? reaches_out : 0);
    at(SurfaceRole::kRoof) = place.first_row < 0.4f ? 0.5f : 0.2f;
    at(SurfaceRole::kElement) = 0.1f + 0.2f * large;
    const float free_standing = (1 - reaches_out) * (1 - 0.5f * large);
    // Limbs and folds have a broken outline, buildings a plain one. Whoever replaces a texture does
    // so on clothes more often than on things.
    const float broken = std::clamp((0.95f - place.solidity) / 0.25f, 0.0f, 1.0f);
    at(SurfaceRole::kWall) *= 1 - 0.7f * free_standing * broken;
    at(SurfaceRole::kProp) = 0.4f + 0.9f * free_standing * (1 - 0.6f * broken);
    at(SurfaceRole::kGarment) = 0.4f + (2.6f + 2.5f * broken) * free_standing;
    at(SurfaceRole::kCoat) = 0.2f + (0.6f + 2.5f * broken) * free_standing;
    return weights;
}

std::string_view role_name(SurfaceRole role) {
    constexpr std::string_view kNames[]{"a wall",           "the ground",       "a roof",
                                        "a garment",        "an animal's coat", "an object",
                                        "a natural element"};
    return kNames[static_cast<std::size_t>(role)];
}

}  // namespace weft

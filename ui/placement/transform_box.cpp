#include "ui/placement/transform_box.h"

#include <algorithm>
#include <cmath>

#include "ui/canvas/angles.h"

namespace weft::ui {
namespace {

constexpr double kLeastScale = 0.001, kMostScale = 1000;

double at_or(const KeyedNumbers& keys, int frame, std::size_t which, double still) {
    return keys.empty() ? still : keys.at(frame)[which];
}

}  // namespace

PlacementNumbers placement_on(const Placement& p, int frame) {
    return {at_or(p.scale_keys, frame, 0, p.scale), at_or(p.rotate_keys, frame, 0, p.rotate_deg),
            at_or(p.offset_keys, frame, 0, p.offset_px.x),
            at_or(p.offset_keys, frame, 1, p.offset_px.y)};
}

std::vector<Edit> edits_of_placement(const Region& region, int frame, const PlacementNumbers& to) {
    const PlacementNumbers now = placement_on(region.placement, frame);
    std::vector<Edit> out;
    const auto set = [&](const char* key, const char* keys_key, KeyedNumbers keys,
                         const std::vector<double>& value) {
        const RegionRef ref{region.id, {}};
        if (keys.empty()) {
            out.emplace_back(SetRegionParameter{
                ref, key, value.size() == 1 ? ParameterValue(value[0]) : ParameterValue(value)});
            return;
        }
        keys.set(frame, value);
        out.emplace_back(SetRegionParameter{ref, keys_key, std::move(keys)});
    };
    const Placement& p = region.placement;
    if (to.scale != now.scale)
        set("placement.scale", "placement.scale_keys", p.scale_keys, {to.scale});
    if (to.rotate_deg != now.rotate_deg)
        set("placement.rotate_deg", "placement.rotate_keys", p.rotate_keys, {to.rotate_deg});
    if (to.x != now.x || to.y != now.y)
        set("placement.offset_px", "placement.offset_keys", p.offset_keys, {to.x, to.y});
    return out;
}

PlacementNumbers unsqueezed(PlacementNumbers numbers, PixelAspect aspect) {
    numbers.x *= static_cast<double>(aspect.ratio());
    return numbers;
}

PlacementNumbers squeezed(PlacementNumbers numbers, PixelAspect aspect) {
    numbers.x /= static_cast<double>(aspect.ratio());
    return numbers;
}

PlacementNumbers scaled_about(PlacementNumbers from, Vec2 pivot, double factor) {
    const double scale = std::clamp(from.scale * factor, kLeastScale, kMostScale);
    const double by = scale / from.scale;
    const auto px = static_cast<double>(pivot.x), py = static_cast<double>(pivot.y);
    return {scale, from.rotate_deg, px + by * (from.x - px), py + by * (from.y - py)};
}

PlacementNumbers turned_about(PlacementNumbers from, Vec2 pivot, double degrees) {
    // Counter-clockwise on a screen whose y points down.
    const double c = std::cos(degrees * kDegree), s = std::sin(degrees * kDegree);
    const auto px = static_cast<double>(pivot.x), py = static_cast<double>(pivot.y);
    const double dx = from.x - px, dy = from.y - py;
    return {from.scale, std::remainder(from.rotate_deg + degrees, 360), px + c * dx + s * dy,
            py - s * dx + c * dy};
}

std::optional<Quad<float>> box_around(const ViewU8x1& matte, double degrees, PixelAspect aspect) {
    const auto c = static_cast<float>(std::cos(degrees * kDegree));
    const auto s = static_cast<float>(std::sin(degrees * kDegree));
    const Vec2 along(c, -s), down(s, c);
    Vec2 low(1e9f), high(-1e9f);
    for (int y = 0; y < matte.height(); ++y) {
        const std::uint8_t* row = matte.row(y);
        const std::uint8_t* const end = row + matte.width();
        const auto inside = [](std::uint8_t v) { return v >= 128; };
        const std::uint8_t* const first = std::find_if(row, end, inside);
        if (first == end) continue;
        const std::uint8_t* last = end;
        while (!inside(last[-1]))
            --last;
        for (const auto x : {first - row, last - row}) {
            for (const int under : {0, 1}) {
                const Vec2 p =
                    aspect.unsqueezed(Vec2(static_cast<float>(x), static_cast<float>(y + under)));
                const Vec2 q(p.x * along.x + p.y * along.y, p.x * down.x + p.y * down.y);
                low = {std::min(low.x, q.x), std::min(low.y, q.y)};
                high = {std::max(high.x, q.x), std::max(high.y, q.y)};
            }
        }
    }
    if (low.x > high.x) return std::nullopt;
    Quad<float> out{low.x * along + low.y * down, high.x * along + low.y * down,
                    high.x * along + high.y * down, low.x * along + high.y * down};
    for (Vec2& corner : out)
        corner = aspect.squeezed(corner);
    return out;
}

}  // namespace weft::ui

// Snapping of what is dragged in the viewer to edges of the plate.
#include <algorithm>

#include "ui/canvas/plate_snap.h"
#include "ui/canvas/snapping.h"

namespace weft::ui {
namespace {

constexpr float kSnapReach = 8;  // screen px, unscaled

// Pixels of the plate's picture for one of the plate: it may be a proxy.
std::optional<Vec2> picture_scale(const Ctx& c) {
    const PicturePtr& picture = c.view.plate_picture;
    const Size plate = c.view.plate.size;
    if (!picture || picture->size.empty() || plate.empty()) return std::nullopt;
    return Vec2(static_cast<float>(picture->size.width) / static_cast<float>(plate.width),
                static_cast<float>(picture->size.height) / static_cast<float>(plate.height));
}

float reach_px(const Ctx& c, const ViewMap& map, Vec2 scale) {
    return c.theme.px(kSnapReach) / std::max(map.zoom, kLeastZoom) * scale.x;
}

}  // namespace

bool snaps(const Ctx& c) {
    return c.state.snap != ImGui::GetIO().KeyCtrl;
}

Vec2 snapped(Ctx& c, const ViewMap& map, Vec2 at, bool snap) {
    const auto scale = picture_scale(c);
    if (!snap || !scale) return at;
    const auto found =
        snapped_to_edge(*c.view.plate_picture, at * *scale, reach_px(c, map, *scale));
    if (!found) return at;
    const Vec2 place = found->at / *scale;
    const ImVec2 on = map.to_screen(place);
    const float r = c.theme.px(found->corner ? 7.0f : 5.0f);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    // A square where edges meet, a diamond on one.
    if (found->corner)
        list.AddRect({on.x - r, on.y - r}, {on.x + r, on.y + r}, c.theme.warn, 0, 0,
                     c.theme.px(1.5f));
    else
        list.AddQuad({on.x - r, on.y}, {on.x, on.y - r}, {on.x + r, on.y}, {on.x, on.y + r},
                     c.theme.warn, c.theme.px(1.5f));
    return place;
}

std::optional<std::pair<Vec2, Vec2>> snapped_segment(Ctx& c, const ViewMap& map, Vec2 from,
                                                     Vec2 to) {
    const auto scale = picture_scale(c);
    if (!snaps(c) || !scale) return std::nullopt;
    const auto found = snapped_to_line(*c.view.plate_picture, from * *scale, to * *scale,
                                       reach_px(c, map, *scale));
    if (!found) return std::nullopt;
    const std::pair ends{found->first / *scale, found->second / *scale};
    ImGui::GetWindowDrawList()->AddLine(map.to_screen(ends.first), map.to_screen(ends.second),
                                        c.theme.warn, c.theme.px(1.5f));
    return ends;
}

}  // namespace weft::ui

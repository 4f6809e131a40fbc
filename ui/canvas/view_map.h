#pragma once
// Converts between plate pixels and screen pixels.

#include <imgui.h>

#include <algorithm>

#include "engine/core/geometry.h"

namespace weft {

/// The plate's position on screen. `zoom`: screen pixels per plate pixel horizontally; `aspect`:
/// pixel aspect ratio.
struct ViewMap {
    ImVec2 min, max;  ///< Screen rectangle of the view.
    Vec2 center;      ///< Plate pixel at its centre.
    float zoom = 1;
    float aspect = 1;

    [[nodiscard]] ImVec2 to_screen(Vec2 p) const {
        return {(min.x + max.x) * 0.5f + (p.x - center.x) * zoom * aspect,
                (min.y + max.y) * 0.5f + (p.y - center.y) * zoom};
    }
    [[nodiscard]] Vec2 to_plate(ImVec2 s) const {
        return {center.x + (s.x - (min.x + max.x) * 0.5f) / (zoom * aspect),
                center.y + (s.y - (min.y + max.y) * 0.5f) / zoom};
    }
    [[nodiscard]] bool contains(ImVec2 s) const {
        return s.x >= min.x && s.x < max.x && s.y >= min.y && s.y < max.y;
    }
};

inline constexpr float kLeastZoom = 0.01f, kMostZoom = 64.0f;

/// The zoom that fits a picture into the view with a margin, in screen pixels.
[[nodiscard]] inline float fit_zoom(ImVec2 view, Size picture, float margin) {
    if (picture.empty()) return 1;
    const float zoom = std::min((view.x - 2 * margin) / static_cast<float>(picture.width),
                                (view.y - 2 * margin) / static_cast<float>(picture.height));
    return std::clamp(zoom, kLeastZoom, kMostZoom);
}

/// The centre after zooming about `at`, whose plate position stays fixed.
[[nodiscard]] inline Vec2 zoom_about(const ViewMap& map, ImVec2 at, float new_zoom) {
    const Vec2 under = map.to_plate(at);
    ViewMap next = map;
    next.zoom = new_zoom;
    const Vec2 moved = next.to_plate(at);
    return map.center + under - moved;
}

}  // namespace weft

#pragma once
// Canvas maths: between the plate's pixels and the screen's.

#include <imgui.h>

#include <algorithm>

#include "engine/core/geometry.h"

namespace weft {

/// Where the plate lies on the screen. `zoom`: screen pixels of a plate pixel across; `aspect`: a
/// pixel's width over its height.
struct ViewMap {
    ImVec2 min, max;  ///< The part of the screen that the view fills.
    Vec2 center;      ///< Plate pixel in its middle.
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

/// The zoom at which a picture fills the view but for a margin, in screen pixels.
[[nodiscard]] inline float fit_zoom(ImVec2 view, Size picture, float margin) {
    if (picture.empty()) return 1;
    const float zoom = std::min((view.x - 2 * margin) / static_cast<float>(picture.width),
                                (view.y - 2 * margin) / static_cast<float>(picture.height));
    return std::clamp(zoom, kLeastZoom, kMostZoom);
}

/// The centre after zooming such that what is under `at` stays there.
[[nodiscard]] inline Vec2 zoom_about(const ViewMap& map, ImVec2 at, float new_zoom) {
    const Vec2 under = map.to_plate(at);
    ViewMap next = map;
    next.zoom = new_zoom;
    const Vec2 moved = next.to_plate(at);
    return map.center + under - moved;
}

}  // namespace weft

#include "engine/motion/surface_flow.h"

#include <algorithm>

namespace weft {
namespace {

// Beyond the surface's box, for patches at its edge.
constexpr int kBoxMargin_px = 8;
constexpr std::uint8_t kNothing = 128;  // what a local mean becomes

// A frame's picture in `box`, as 8-bit luma; outside of the surface it shows nothing.
Matte freed_of_light(const SurfaceView& view, const Recti& box) {
    constexpr float kLevels = 30;  // of a local deviation
    Matte out(Size{box.width(), box.height()}, kNothing);
    const Recti area = view.picture.area;  // within the box
    for (int y = area.y0; y < area.y1; ++y) {
        const float* value = view.picture.value.row(y - area.y0);
        const std::uint8_t* seen = view.visible.row(y);
        std::uint8_t* to = out.row(y - box.y0);
        for (int x = area.x0; x < area.x1; ++x) {
            if (seen[x] < 128) continue;
            const float level = static_cast<float>(kNothing) + kLevels * value[x - area.x0];
            to[x - box.x0] = static_cast<std::uint8_t>(std::clamp(level + 0.5f, 0.0f, 255.0f));
        }
    }
    return out;
}

}  // namespace

FlowField estimate_surface_flow(const SurfaceView& cur, const SurfaceView& prev, Size frame,
                                FlowQuality quality) {
    FlowField out(frame);
    std::fill_n(out.valid.data(), out.valid.size_bytes(), std::uint8_t{0});
    Recti box = cur.picture.area.united(prev.picture.area);
    if (cur.picture.area.empty() || prev.picture.area.empty()) return out;
    box = box.grown(kBoxMargin_px).intersected(rect_of(frame));
    FlowPair found =
        estimate_flows(freed_of_light(cur, box), freed_of_light(prev, box), quality, frame);
    check_consistency(found.b_from_a, found.a_from_b.d);
    for (int y = box.y0; y < box.y1; ++y) {
        std::copy_n(found.b_from_a.d.row(y - box.y0), 2 * box.width(), out.d.pixel(box.x0, y));
        std::copy_n(found.b_from_a.valid.row(y - box.y0), box.width(), out.valid.pixel(box.x0, y));
    }
    return out;
}

}  // namespace weft

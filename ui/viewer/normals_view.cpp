#include "ui/viewer/normals_view.h"

#include <cmath>

#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

constexpr int kPane = 900;  // its slot; those of the viewer are small
constexpr int kBallSteps = 26;

ImU32 color_of(float x, float y, float z) {
    const auto code = [](float v) { return static_cast<int>(127.5f + 127.5f * v + 0.5f); };
    return IM_COL32(code(x), code(y), code(z), 255);
}

// A ball that faces the camera, in small squares.
void draw_ball(ImDrawList& list, ImVec2 centre, float radius) {
    const float side = 2 * radius / kBallSteps;
    for (int j = 0; j < kBallSteps; ++j) {
        for (int i = 0; i < kBallSteps; ++i) {
            const float x = (static_cast<float>(i) + 0.5f) * 2 / kBallSteps - 1;
            const float y = (static_cast<float>(j) + 0.5f) * 2 / kBallSteps - 1;
            const float square = 1 - x * x - y * y;
            if (square < 0) continue;
            const ImVec2 at(centre.x + x * radius - 0.5f * side,
                            centre.y + y * radius - 0.5f * side);
            list.AddRectFilled(at, {at.x + side + 0.5f, at.y + side + 0.5f},
                               color_of(x, -y, std::sqrt(square)));
        }
    }
}

}  // namespace

void draw_normals_overlay(Ctx& c, ImDrawList& list, const ViewMap& map,
                          const OverlayPicture& over) {
    if (!over.colours) return;
    PictureDraw draw;
    draw.a = over.colours;
    draw.pane = kPane;
    draw.min = map.to_screen({0, 0});
    draw.max = map.to_screen({static_cast<float>(over.colours->size.width),
                              static_cast<float>(over.colours->size.height)});
    draw.clip_min = map.min;
    draw.clip_max = map.max;
    c.pictures.draw(list, draw);
}

void draw_normals_legend(Ctx& c, ImDrawList& list, ImVec2 min, ImVec2 max,
                         const OverlayPicture* over) {
    const Theme& t = c.theme;
    const bool flat = over && !over->colours;
    const float w = t.px(220), h = over && !flat ? t.px(84) : t.px(26);
    const ImVec2 a(max.x - w - t.px(10), min.y + t.px(10)), b(a.x + w, a.y + h);
    list.AddRectFilled(a, b, t.scrim, t.radius);
    const char* text = !over  ? "Normals: Rendering…"
                       : flat ? "Normals: the form is flat"
                              : "Normals of the form";
    text_in(list, t.small, {a.x + t.px(8), a.y}, {b.x, a.y + t.px(26)}, t.text, text, 0);
    if (!over || flat) return;
    const float radius = t.px(24);
    draw_ball(list, {a.x + t.px(10) + radius, a.y + t.px(28) + radius}, radius);
    const char* const lines[] = {"Red: to the right", "Green: upwards", "Blue: to the camera"};
    float y = a.y + t.px(26);
    for (const char* line : lines) {
        text_in(list, t.small, {a.x + t.px(72), y}, {b.x, y + t.px(17)}, t.quiet, line, 0);
        y += t.px(17);
    }
}

}  // namespace weft::ui

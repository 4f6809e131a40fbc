// The viewer: the picture, its overlays and tools.
#include "ui/viewer/viewer.h"

#include <imgui_internal.h>  // BeginDragDropTargetCustom

#include <algorithm>
#include <cmath>

#include "ui/base/icons.h"
#include "ui/canvas/handles.h"
#include "ui/mask/mask.h"
#include "ui/viewer/compare.h"
#include "ui/viewer/overlays.h"
#include "ui/viewer/parts.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

struct Pane {
    ViewMap map;
    PicturePtr a, b;
    PictureDraw::Mode mode = PictureDraw::Mode::kSingle;
    std::string label;
    bool mattes = true;
};

PicturePtr shown_result(const Ctx& c) {
    return c.view.result_picture ? c.view.result_picture : c.view.plate_picture;
}

// What one paints a mask over: other regions' textures would hide the surface.
PicturePtr shown_alone(const Ctx& c) {
    return paints_over_plate(c) ? c.view.plate_picture : shown_result(c);
}

std::vector<Pane> panes_of(Ctx& c, ImVec2 min, ImVec2 max) {
    const SessionView& v = c.view;
    const ViewerState& s = c.state.viewer;
    const PicturePtr other = compared_picture(c);
    const std::string name = compared_name(c);
    ViewMap whole{min, max, s.center, s.zoom, s.aspect};
    const auto part = [&](float x0, float y0, float x1, float y1) {
        ViewMap map = whole;
        const float w = max.x - min.x, h = max.y - min.y;
        map.min = {std::floor(min.x + x0 * w), std::floor(min.y + y0 * h)};
        map.max = {std::floor(min.x + x1 * w), std::floor(min.y + y1 * h)};
        return map;
    };
    if (s.hold_original) return {{whole, v.plate_picture, nullptr, {}, "Plate", false}};
    switch (s.compare) {
        case Compare::kPlate:
            return {{whole, other, nullptr, {}, name, true}};
        case Compare::kWipe:
            return {{whole, other, shown_result(c), PictureDraw::Mode::kWipe, "", true}};
        case Compare::kDifference:
            return {{whole, other, shown_result(c), PictureDraw::Mode::kDifference,
                     "Difference × 4", false}};
        case Compare::kSideBySide:
            return {{part(0, 0, 0.5f, 1), other, nullptr, {}, name, true},
                    {part(0.5f, 0, 1, 1), v.result_picture, nullptr, {}, "Result", false}};
        case Compare::kFourUp: {
            const auto stage = [&](Stage which) {
                return v.stages.stages[static_cast<std::size_t>(which)];
            };
            return {
                {part(0, 0, 0.5f, 0.5f), v.plate_picture, nullptr, {}, "Plate", false},
                {part(0.5f, 0, 1, 0.5f), stage(Stage::kTexture), nullptr, {}, "Texture", false},
                {part(0, 0.5f, 0.5f, 1), stage(Stage::kLit), nullptr, {}, "With shading", false},
                {part(0.5f, 0.5f, 1, 1), v.result_picture, nullptr, {}, "Final", false}};
        }
        case Compare::kResult:
            break;
    }
    if (v.layer)
        return {{whole,
                 v.stages.layer_kind == v.layer ? v.stages.layer : nullptr,
                 nullptr,
                 {},
                 "",
                 false}};
    return {{whole, shown_alone(c), nullptr, {}, "", true}};
}

void read_pixel(Ctx& c, const ViewMap& map, const PicturePtr& picture, bool hovered) {
    ViewerState& s = c.state.viewer;
    s.pixel.reset();
    if (!hovered || !picture) return;
    const Vec2 p = map.to_plate(ImGui::GetIO().MousePos);
    const Vec2i at(static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)));
    const Size plate = c.view.plate.size;
    if (!rect_of(plate).contains(at.x, at.y)) return;
    s.pixel = at;
    // The picture may be a proxy of the frame.
    s.value = picture->at(at.x * picture->size.width / plate.width,
                          at.y * picture->size.height / plate.height);
}

void navigate(Ctx& c, const ViewMap& map, bool hovered, bool active, bool wiping) {
    ViewerState& s = c.state.viewer;
    const ImGuiIO& io = ImGui::GetIO();
    if (hovered && io.MouseWheel != 0) {
        const float zoom =
            std::clamp(s.zoom * std::pow(1.2f, io.MouseWheel), kLeastZoom, kMostZoom);
        s.center = zoom_about(map, io.MousePos, zoom);
        s.zoom = zoom;
        s.fit = false;
    }
    const bool pan = ImGui::IsMouseDragging(2, 0) || (c.state.tool == Tool::kPan && active &&
                                                      !wiping && ImGui::IsMouseDragging(0, 1));
    if (pan && (hovered || active)) {
        s.center.x -= io.MouseDelta.x / (s.zoom * s.aspect);
        s.center.y -= io.MouseDelta.y / s.zoom;
        s.fit = false;
    }
}

// Lets the user drag the wipe line; returns true while the mouse is on it.
bool move_wipe(Ctx& c, const ViewMap& map, bool hovered) {
    ViewerState& s = c.state.viewer;
    if (s.compare != Compare::kWipe || s.hold_original) return false;
    const float width = static_cast<float>(c.view.plate.size.width);
    const float x = map.to_screen({s.wipe * width, 0}).x;
    // A stroke or a drag of another tool that passes the line goes on.
    const bool free = ImGui::IsMouseClicked(0) || !ImGui::IsMouseDown(0);
    const bool near = hovered && free && std::abs(ImGui::GetIO().MousePos.x - x) < c.theme.px(7);
    if (near && ImGui::IsMouseClicked(0)) s.dragging_wipe = true;
    if (!ImGui::IsMouseDown(0)) s.dragging_wipe = false;
    if (s.dragging_wipe)
        s.wipe = std::clamp(map.to_plate(ImGui::GetIO().MousePos).x / width, 0.0f, 1.0f);
    if (near || s.dragging_wipe) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    return near || s.dragging_wipe;
}

void draw_wipe(Ctx& c, ImDrawList& list, const ViewMap& map) {
    const ViewerState& s = c.state.viewer;
    if (s.compare != Compare::kWipe || s.hold_original) return;
    const float x = map.to_screen({s.wipe * static_cast<float>(c.view.plate.size.width), 0}).x;
    list.AddLine({x, map.min.y}, {x, map.max.y}, IM_COL32(0, 0, 0, 140), c.theme.px(3));
    list.AddLine({x, map.min.y}, {x, map.max.y}, c.theme.accent_hover, c.theme.px(1));
    const float y = map.max.y - c.theme.px(64);
    list.AddCircleFilled({x, y}, c.theme.px(9), c.theme.accent, 24);
    icon_in(c, list, {x - c.theme.px(9), y - c.theme.px(9)}, {x + c.theme.px(9), y + c.theme.px(9)},
            c.theme.on_accent, icons::kCompare);
}

// Offers to relink missing frames.
void relink(Ctx& c) {
    const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    const float w = c.theme.px(180);
    ImGui::SetCursorScreenPos(
        {std::floor(at.x + (size.x - w) / 2), std::floor(at.y + size.y / 2 + c.theme.px(64))});
    if (!button(c, "Relink plate…",
                {.icon = icons::kFolderOpen, .look = Look::kPrimary, .width = w}))
        return;
    c.state.browser.purpose = BrowserState::Purpose::kPlate;
    c.state.browser.just_opened = true;
}

// Shows the full error message in the viewer.
void failure(Ctx& c, ImDrawList& list, ImVec2 min, ImVec2 max) {
    if (c.view.preview.state != PreviewView::State::kFailed || !c.view.result_wanted) return;
    // The question about missing files stands there and names the cause.
    if (!c.view.missing.empty() && !c.state.missing_dismissed) return;
    const Theme& t = c.theme;
    const float width = std::min(t.px(560), max.x - min.x - t.px(24));
    const std::string text = "No result yet. " + c.view.preview.error;
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width - t.px(50));
    const ImVec2 a(std::floor((min.x + max.x - width) / 2), min.y + t.px(12));
    const ImVec2 b(a.x + width, a.y + size.y + t.px(20));
    list.AddRectFilled(a, b, t.panel, t.px(4));
    list.AddRectFilled(a, {a.x + t.px(4), b.y}, t.bad);
    icon_in(c, list, {a.x + t.px(12), a.y}, {a.x + t.px(32), b.y}, t.bad, icons::kAlert);
    list.AddText(t.regular, t.regular->FontSize, {a.x + t.px(40), a.y + t.px(10)}, t.text,
                 text.c_str(), nullptr, width - t.px(50));
}

// A movie is read to its end, since what its file says of its length may be wrong.
void opening(Ctx& c, const PlateView& plate) {
    const std::string heading =
        plate.counted > 0 ? "Counting the movie's frames: " + std::to_string(plate.counted)
                          : "Opening the plate…";
    empty_state(c, icons::kTimer, heading.c_str(), plate.path.c_str());
    c.note(heading);
}

void no_picture(Ctx& c) {
    const PlateView& plate = c.view.plate;
    switch (plate.state) {
        case PlateView::State::kNone:
            empty_state(c, icons::kFilm, "No plate yet",
                        "Drop a folder of frames, a sequence or a movie here, or press Ctrl+O to "
                        "find one.");
            break;
        case PlateView::State::kOpening:
            opening(c, plate);
            break;
        case PlateView::State::kFailed:
            empty_state(c, icons::kAlert, "Cannot open the plate", plate.error.c_str());
            relink(c);
            break;
        case PlateView::State::kOpen:
            if (!c.view.frame_error.empty())
                empty_state(c, icons::kAlert, "Cannot read this frame", c.view.frame_error.c_str());
            break;
    }
}

}  // namespace

void viewer(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    begin_panel(c, "Viewer", size, t.surround, false, 0);
    // A bar at the bottom describes the view, so that nothing covers the picture.
    const float bar_h = t.px(30);
    const ImVec2 min = ImGui::GetCursorScreenPos(), foot(min.x + size.x, min.y + size.y);
    size.y = std::max(t.px(40), size.y - bar_h);
    const ImVec2 max(min.x + size.x, min.y + size.y);
    ViewerState& s = c.state.viewer;
    const bool two_wide = s.compare == Compare::kSideBySide, four = s.compare == Compare::kFourUp;
    const Size plate = c.view.plate.size;
    const double aspect = s.aspect_dragged.value_or(c.view.plate.pixel_aspect);
    s.aspect =
        s.squeezed
            ? 1
            : PixelAspect(std::clamp(aspect, PixelAspect::kLeast, PixelAspect::kMost)).ratio();
    if (s.fit && !plate.empty()) {
        const ImVec2 one(size.x * (two_wide || four ? 0.5f : 1.0f), size.y * (four ? 0.5f : 1.0f));
        const Size shown{static_cast<int>(static_cast<float>(plate.width) * s.aspect),
                         plate.height};
        s.zoom = fit_zoom(one, shown, t.px(four || two_wide ? 4 : 12));
        s.center = Vec2(static_cast<float>(plate.width), static_cast<float>(plate.height)) * 0.5f;
    }
    s.hold_original =
        !ImGui::GetIO().WantTextInput && chord_down(*parse_chord("`")) && !ImGui::GetIO().KeyCtrl;
    if (!c.view.plate_picture) {
        no_picture(c);
        if (c.view.plate.state != PlateView::State::kOpen) {
            end_panel(c);
            return;
        }
    }
    ImGui::SetCursorScreenPos(min);
    ImGui::SetItemAllowOverlap();
    ImGui::InvisibleButton("##canvas", size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle |
                               ImGuiButtonFlags_MouseButtonRight);
    c.note("Canvas");
    ImGui::SetItemAllowOverlap();
    const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const std::vector<Pane> panes = panes_of(c, min, max);
    // Tools work in the pane under the mouse; all panes share zoom and centre.
    ViewMap map = panes.front().map;
    for (const Pane& pane : panes)
        if (pane.map.contains(ImGui::GetIO().MousePos)) map = pane.map;
    const bool wiping = panes.size() == 1 && move_wipe(c, map, hovered);
    if (!wiping) brush_input(c, map, active);
    const Vec2 corner(static_cast<float>(plate.width), static_cast<float>(plate.height));
    for (const Pane& pane : panes) {
        if (pane.a || pane.b) {
            PictureDraw draw;
            draw.a = pane.a ? pane.a : pane.b;
            draw.b = pane.b;
            draw.mode = pane.a && pane.b ? pane.mode : PictureDraw::Mode::kSingle;
            draw.min = pane.map.to_screen({0, 0});
            draw.max = pane.map.to_screen(corner);
            draw.clip_min = pane.map.min;
            draw.clip_max = pane.map.max;
            draw.wipe = s.wipe;
            draw.pane = static_cast<int>(&pane - panes.data());
            draw.smooth = s.zoom < 4;
            draw.display = on_screen(s.display, c.view);
            c.pictures.draw(list, draw);
        } else if (c.view.plate_picture) {
            text_in(list, t.regular, pane.map.min, pane.map.max, t.off,
                    c.view.result_wanted ? "Rendering…" : "Nothing to show yet");
        }
        if (pane.mattes && s.mattes_shown) draw_mattes(c, list, pane.map);
        draw_overlay(c, list, pane.map);
        if (panes.size() > 1) {
            list.AddRect(pane.map.min, pane.map.max, t.line);
            picture_pill(c, list, {pane.map.min.x + t.px(10), pane.map.min.y + t.px(10)},
                         pane.label, t.text);
        }
    }
    read_pixel(c, map, s.compare != Compare::kPlate ? shown_alone(c) : c.view.plate_picture,
               hovered);
    navigate(c, map, hovered, active, wiping);
    if (panes.size() == 1) draw_wipe(c, list, map);
    if (!wiping && !take_back_drag(c)) viewer_tools(c, map, hovered, active);
    if (panes.front().mattes && s.mattes_shown)
        draw_matte_state(c, list, {min.x + t.px(10), min.y + t.px(10)});
    draw_legend(c, list, min, max);
    draw_provenance(c, list, map, hovered);
    failure(c, list, min, max);
    draw_state(c, list, {min.x, max.y}, foot);
    view_controls(c, {min.x, max.y}, foot);
    if (ImGui::BeginDragDropTargetCustom(ImRect(min, max), ImGui::GetID("##drop"))) {
        if (const ImGuiPayload* payload = ImGui::AcceptDragDropPayload("TEXTURE"))
            drop_texture(c, map, std::string(static_cast<const char*>(payload->Data)));
        ImGui::EndDragDropTarget();
    }
    end_panel(c);
}

}  // namespace weft::ui

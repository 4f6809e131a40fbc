// Tools for roto shapes and scribbles.
#include <algorithm>
#include <cmath>

#include "ui/canvas/handles.h"
#include "ui/mask/mask.h"
#include "ui/mask/shape_box.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

void outline(Ctx& c, const ViewMap& map, const std::vector<Vec2>& points, bool closed,
             ImU32 color) {
    std::vector<ImVec2> on_screen;
    for (const Vec2 p : points)
        on_screen.push_back(map.to_screen(p));
    const int count = static_cast<int>(on_screen.size());
    const ImDrawFlags flags = closed ? ImDrawFlags_Closed : ImDrawFlags_None;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddPolyline(on_screen.data(), count, IM_COL32(0, 0, 0, 170), flags, c.theme.px(3));
    list.AddPolyline(on_screen.data(), count, color, flags, c.theme.px(1.5f));
}

void finish_drawing(Ctx& c) {
    constexpr std::size_t kLeast = 3;
    if (c.state.shape.points.size() >= kLeast) c.emit(SetShape{c.state.shape});
    c.state.shape_drawing = false;
}

// A click adds a corner, a drag a curve point; clicking the first point, or Enter, closes the
// shape.
void draw_new(Ctx& c, const ViewMap& map, bool hovered, bool active) {
    RotoShape& shape = c.state.shape;
    const Vec2 mouse = map.to_plate(ImGui::GetIO().MousePos);
    if (keys_for_picture(c)) {
        if (ImGui::IsKeyPressed(257)) return finish_drawing(c);
        if (ImGui::IsKeyPressed(259) && !shape.points.empty()) shape.points.pop_back();
        if (ImGui::IsKeyPressed(256) || shape.points.empty()) {
            c.state.shape_drawing = false;
            return;
        }
    }
    const ImVec2 first = map.to_screen(shape.points.front().at), now = ImGui::GetIO().MousePos;
    const bool closes =
        shape.points.size() > 2 && std::hypot(first.x - now.x, first.y - now.y) < c.theme.px(9);
    if (active && ImGui::IsMouseClicked(0)) {
        if (closes) return finish_drawing(c);
        shape.points.push_back({mouse, {0, 0}, {0, 0}, 0});
    } else if (ImGui::IsMouseDown(0) && active) {
        RotoPoint& last = shape.points.back();
        const Vec2 pull = mouse - last.at;
        if (std::hypot(pull.x, pull.y) * map.zoom > c.theme.px(4)) {
            last.out = pull;
            last.in = pull * -1.0f;
        }
    }
    std::vector<Vec2> line;
    RotoShape open = shape;
    if (hovered && !ImGui::IsMouseDown(0)) open.points.push_back({mouse, {0, 0}, {0, 0}, 0});
    constexpr std::size_t kSteps = 16;
    line = outline_of(open, kSteps);
    // without the closing segment
    line.resize(std::max<std::size_t>(1, line.size() - (kSteps - 1)));
    outline(c, map, line, false, c.theme.accent_hover);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const RotoPoint& p : shape.points)
        list.AddCircleFilled(map.to_screen(p.at), c.theme.px(3.5f), c.theme.accent_hover, 12);
    if (closes) list.AddCircle(first, c.theme.px(8), c.theme.accent_hover, 20, c.theme.px(2));
}

// Edits the points of an existing shape. Returns true if a drag ended.
bool edit_points(Ctx& c, const ViewMap& map, bool hovered, bool& over) {
    bool done = false;
    const ImU32 color = c.theme.accent_hover;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (std::size_t k = 0; k < c.state.shape.points.size(); ++k) {
        RotoPoint& p = c.state.shape.points[k];
        const std::string id = "point " + std::to_string(k + 1);
        const auto tangent = [&](const char* name, Vec2& way, Vec2& other) {
            if (way == Vec2{0, 0}) return;
            Vec2 end = p.at + way;
            list.AddLine(map.to_screen(p.at), map.to_screen(end), faded(color, 0.6f),
                         c.theme.px(1));
            const Grip grip = handle(c, map, id + name, end, hovered, color, false);
            over |= grip != Grip::kNone;
            if (grip != Grip::kHeld && grip != Grip::kLetGo) return;
            way = end - p.at;
            // Both handles stay collinear unless they are broken.
            const float length = std::hypot(way.x, way.y), opposite = std::hypot(other.x, other.y);
            if (!breaks_off() && length > 0 && opposite > 0) other = way * (-opposite / length);
            done |= grip == Grip::kLetGo;
        };
        tangent(" in", p.in, p.out);
        tangent(" out", p.out, p.in);
        Vec2 at = p.at;
        const Grip grip = handle(c, map, id, at, hovered, color);
        over |= grip != Grip::kNone;
        if (p.feather_px > 0) plate_circle(c, map, p.at, p.feather_px, faded(color, 0.5f), 1);
        if (grip == Grip::kTaken && breaks_off() && c.state.shape.points.size() > 3) {
            c.state.handle_held.clear();
            c.state.shape.points.erase(c.state.shape.points.begin() +
                                       static_cast<std::ptrdiff_t>(k));
            return true;
        }
        if (grip != Grip::kHeld && grip != Grip::kLetGo) continue;
        // Ctrl drags the feather, Shift moves the whole shape.
        if (ImGui::GetIO().KeyCtrl && !ImGui::GetIO().KeyShift) {
            const Vec2 way = plate_aspect(c).unsqueezed(at - p.at);
            p.feather_px = std::hypot(way.x, way.y);
        } else if (ImGui::GetIO().KeyShift) {
            const Vec2 by = at - p.at;
            for (RotoPoint& each : c.state.shape.points)
                each.at += by;
        } else {
            p.at = at;
        }
        done |= grip == Grip::kLetGo;
    }
    return done;
}

}  // namespace

void shape_tool(Ctx& c, const ViewMap& map, bool hovered, bool active) {
    UiState& s = c.state;
    if (!c.view.selected_region() && !c.view.project.regions.empty()) return;
    if (s.shape_drawing) return draw_new(c, map, hovered, active);
    if (!any_handle_held(c) && !c.view.matte_busy)
        s.shape = c.view.shape ? *c.view.shape : RotoShape{};
    bool over = false;
    if (!s.shape.points.empty()) {
        outline(c, map, outline_of(s.shape), true, c.theme.accent_hover);
        // Points first: they are smaller, and may lie near the box.
        if (edit_points(c, map, hovered, over) || shape_box(c, map, hovered && !over, over) ||
            shape_inside(c, map, active, hovered && !over)) {
            c.emit(SetShape{s.shape});
            return;
        }
    }
    if (over || any_handle_held(c) || !active || !ImGui::IsMouseClicked(0)) return;
    if (!s.shape.points.empty() && !breaks_off()) return;  // it starts a new shape
    s.shape = {};
    s.shape.points.push_back({map.to_plate(ImGui::GetIO().MousePos), {0, 0}, {0, 0}, 0});
    s.shape_drawing = true;
}

namespace {

ScribbleSelect scribbles(const Ctx& c) {
    ScribbleSelect out;
    out.here_only = c.settings.here_only;
    for (const Scribble& one : c.state.scribbles.lines)
        (one.outside ? out.drop : out.keep).push_back(one.line);
    return out;
}

// Lines whose step of the history was undone, also before it was there.
void take_undone_away(ScribbleState& s, const SessionView& view) {
    const int position = view.history_position;
    for (Scribble& one : s.lines)
        one.settled |= position >= one.step;
    std::erase_if(s.lines, [&](const Scribble& one) {
        return position < one.step && (one.settled || !view.matte_busy);
    });
}

// What is painted on the frame: the files that say so.
std::string painted_here(const SessionView& view) {
    const MatteSource source = view.painted_source();
    std::string out;
    if (const auto key = source.keyframes.find(view.frame); key != source.keyframes.end())
        out = key->second.path;
    if (const auto part = source.confirmed.find(view.frame); part != source.confirmed.end())
        out += "\n" + part->second.path;
    return out;
}

void forget_scribbles(ScribbleState& s) {
    s.lines.clear();
    s.kept.erase({s.region, s.frame});
}

// Lines of before would say something of a matte that is another one now.
void take_painted_over_away(ScribbleState& s, const SessionView& view) {
    if (s.lines.empty() || view.matte_busy) return;
    const std::string now = painted_here(view);
    // Its own steps, and the way back to them, change what is painted, too.
    const int position = view.history_position;
    if (position <= s.lines.back().step) s.matte = now;
    if (s.matte != now) forget_scribbles(s);
}

// Scribbles belong to one frame of one region, and wait there.
void go_to_scribbles(ScribbleState& s, const SessionView& view) {
    if (s.frame == view.frame && s.region == view.selected) return;
    // The first line has begun the first region.
    if (s.frame == view.frame && s.region == 0 && !s.lines.empty()) {
        s.region = view.selected;
        return;
    }
    if (s.lines.empty())
        s.kept.erase({s.region, s.frame});
    else
        s.kept[{s.region, s.frame}] = {s.lines, s.matte};
    s.frame = view.frame;
    s.region = view.selected;
    s.drawing = false;
    const auto kept = s.kept.find({s.region, s.frame});
    const bool any = kept != s.kept.end();
    s.lines = any ? kept->second.lines : std::vector<Scribble>();
    s.matte = any ? kept->second.matte : std::string();
}

}  // namespace

void scribble_tool(Ctx& c, const ViewMap& map, bool active) {
    ScribbleState& s = c.state.scribbles;
    go_to_scribbles(s, c.view);
    if (active && ImGui::IsMouseClicked(0)) {
        s.drawing = true;
        // The one before is a step of its own, which may still be on its way.
        const int step = c.view.history_position + (c.view.matte_busy ? 2 : 1) +
                         (c.view.project.regions.empty() ? 1 : 0);  // which is begun, too
        s.lines.push_back({{map.to_plate(ImGui::GetIO().MousePos)}, subtracts(), step, false});
    } else if (s.drawing) {
        const std::size_t before = s.lines.back().line.size();
        for (const Vec2 point : path_on_plate(c, map))
            s.lines.back().line.push_back(point);
        ScribbleSelect all = scribbles(c);
        s.drawing = ImGui::IsMouseDown(0);
        if (s.drawing && s.lines.back().line.size() > before)
            c.emit(TryScribble{std::move(all)});
        else if (!s.drawing)
            c.emit(std::move(all));
    } else {
        take_undone_away(s, c.view);
        take_painted_over_away(s, c.view);
    }
    if (keys_for_picture(c) && ImGui::IsKeyPressed(256)) {
        forget_scribbles(s);
        s.drawing = false;
        c.emit(TryScribble{});
    }
    for (const Scribble& one : s.lines)
        outline(c, map, one.line, false, one.outside ? c.theme.bad : c.theme.good);
}

}  // namespace weft::ui

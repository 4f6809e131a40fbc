// Tool for the form of a surface: shapes and strokes drawn over it on its reference frame.
#include <algorithm>

#include "ui/canvas/handles.h"
#include "ui/canvas/snapping.h"
#include "ui/form/drawing.h"
#include "ui/form/form.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

void draw_lines(Ctx& c, const ViewMap& map, const FormGuide& guide, ImU32 color) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const std::vector<Vec2>& line : lines_of(guide, plate_aspect(c))) {
        std::vector<ImVec2> on_screen;
        for (const Vec2 p : line)
            on_screen.push_back(map.to_screen(p));
        const int count = static_cast<int>(on_screen.size());
        list.AddPolyline(on_screen.data(), count, IM_COL32(0, 0, 0, 120), 0, c.theme.px(3));
        list.AddPolyline(on_screen.data(), count, color, 0, c.theme.px(1.5f));
    }
}

ViewU8x1 matte_of(const Ctx& c) {
    for (const RegionMatteView& matte : c.view.mattes)
        if (matte.region == c.view.selected) return matte.pixels;
    return {};
}

std::string id_of(const FormGuide& guide, std::size_t index) {
    std::string out = "form " + std::string(info_of(guide.kind).name);
    return is_shape(guide.kind) ? out : out + " " + std::to_string(index + 1);
}

// A stroke lies on a straight edge of the plate as a whole, if there is one beside it.
FormGuide with_snapped_handle(Ctx& c, const ViewMap& map, const FormGuide& guide, std::size_t k,
                              Vec2 at) {
    const PixelAspect aspect = plate_aspect(c);
    if (!snaps(c)) return with_handle_at(guide, k, at, aspect);
    if (!is_shape(guide.kind)) {
        const std::size_t other = k ^ 1U;
        const auto ends = snapped_segment(c, map, handles_of(guide, plate_aspect(c))[other].at, at);
        if (ends)
            return with_handle_at(with_handle_at(guide, other, ends->first, aspect), k,
                                  ends->second, aspect);
    }
    return with_handle_at(guide, k, snapped(c, map, at, true), aspect);
}

// What a drag draws, its ends on edges of the plate while they snap.
std::optional<FormGuide> drawn_guide(Ctx& c, const ViewMap& map, FormGuideKind kind, Vec2 from,
                                     Vec2 to) {
    const PixelAspect aspect = plate_aspect(c);
    if (!snaps(c)) return guide_of_drag(kind, from, to, matte_of(c), aspect);
    if (!is_shape(kind))
        if (const auto ends = snapped_segment(c, map, from, to))
            return guide_of_drag(kind, ends->first, ends->second, matte_of(c), aspect);
    const Vec2 begin = snapped(c, map, from, true);
    return guide_of_drag(kind, begin, snapped(c, map, to, true), matte_of(c), aspect);
}

struct Touched {
    bool over = false, done = false;
    std::optional<std::size_t> removed;  // the handle
};

// Why a render would refuse what is drawn; null: it would not.
const std::string* problem_of(const Ctx& c) {
    const auto found = c.view.form_problems.find(c.view.selected);
    return found == c.view.form_problems.end() ? nullptr : &found->second;
}

// Says on the drawing why it cannot be used.
void show_problem(Ctx& c, const ViewMap& map, const FormToolState& drawn) {
    const std::string* why = problem_of(c);
    if (!why || any_handle_held(c)) return;
    ImVec2 at(map.max.x, map.max.y);
    for (const auto* guides : {&drawn.shape, &drawn.strokes})
        for (const FormGuide& guide : *guides)
            for (const GuideHandle& one : handles_of(guide, plate_aspect(c))) {
                const ImVec2 place = map.to_screen(one.at);
                at = {std::min(at.x, place.x), std::min(at.y, place.y)};
            }
    const Theme& t = c.theme;
    const float width = std::min(t.px(360), map.max.x - map.min.x - t.px(16));
    const ImVec2 size = t.small->CalcTextSizeA(t.small->FontSize, width, width, why->c_str());
    const float pad = t.px(8);
    at.x = std::clamp(at.x, map.min.x + pad, std::max(map.min.x, map.max.x - size.x - 3 * pad));
    at.y = std::clamp(at.y, map.min.y + pad, std::max(map.min.y, map.max.y - size.y - 3 * pad));
    const ImVec2 end(at.x + size.x + 2 * pad, at.y + size.y + 2 * pad);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, end, t.scrim, t.radius);
    list.AddRect(at, end, t.bad, t.radius);
    list.AddText(t.small, t.small->FontSize, {at.x + pad, at.y + pad}, t.text, why->c_str(),
                 nullptr, width);
    c.note("Form problem", at, end);
}

// The handles of a guide, which they change.
Touched drag_guide_handles(Ctx& c, const ViewMap& map, bool hovered, std::size_t index,
                           FormGuide& guide) {
    Touched out;
    const std::vector<GuideHandle> handles = handles_of(guide, plate_aspect(c));
    const ImU32 color = problem_of(c)          ? c.theme.bad
                        : is_shape(guide.kind) ? c.theme.accent_hover
                                               : c.theme.warn;
    draw_lines(c, map, guide, color);
    for (std::size_t k = 0; k < handles.size(); ++k) {
        Vec2 at = handles[k].at;
        const Grip grip = handle(c, map, id_of(guide, index) + " " + handles[k].name, at, hovered,
                                 color, handles[k].filled);
        out.over |= grip != Grip::kNone;
        if (grip == Grip::kTaken && subtracts()) {
            c.state.handle_held.clear();
            out.removed = k;
        }
        if (grip != Grip::kHeld && grip != Grip::kLetGo) continue;
        const FormGuide changed = with_snapped_handle(c, map, guide, k, at);
        if (check_form_guide(changed)) guide = changed;
        out.done |= grip == Grip::kLetGo;
    }
    return out;
}

void set_form(Ctx& c, const Region& region) {
    std::vector<Edit> edits = edits_of_form(region, c.state.form.shape, c.state.form.strokes);
    if (!edits.empty()) c.emit(DoEdits{std::move(edits), "Draw form"});
}

// What was drawn takes the place of what contradicts it: a shape of parallel strokes and the other
// way round.
void take(Ctx& c, const Region& region, const FormGuide& drawn) {
    FormToolState& s = c.state.form;
    const auto parallel = [](const FormGuide& stroke) {
        return stroke.kind == FormGuideKind::kParallel;
    };
    if (is_shape(drawn.kind)) {
        s.shape = {drawn};
        std::erase_if(s.strokes, parallel);
    } else if (drawn.kind == FormGuideKind::kLevel || drawn.kind == FormGuideKind::kCut) {
        s.strokes.push_back(drawn);
    } else {
        if (!s.parallel && std::none_of(s.strokes.begin(), s.strokes.end(), parallel)) {
            s.parallel = drawn;
            return;
        }
        if (s.parallel) s.strokes.push_back(*s.parallel);
        s.parallel.reset();
        s.shape.clear();
        add_parallel(drawn, s.strokes, plate_aspect(c));
    }
    set_form(c, region);
}

void draw_new_guide(Ctx& c, const ViewMap& map, const Region& region) {
    FormToolState& s = c.state.form;
    const Vec2 to = map.to_plate(ImGui::GetIO().MousePos);
    const auto drawn = drawn_guide(c, map, s.kind, *s.from, to);
    if (drawn) draw_lines(c, map, *drawn, c.theme.accent_hover);
    if (ImGui::IsKeyPressed(256)) s.from.reset();
    if (ImGui::IsMouseDown(0) || !s.from) return;
    const ImVec2 a = map.to_screen(*s.from), b = map.to_screen(to);
    s.from.reset();
    // A click draws nothing.
    const float reach = std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
    if (drawn && reach >= c.theme.px(6)) take(c, region, *drawn);
}

}  // namespace

void form_tool(Ctx& c, const ViewMap& map, bool hovered, bool active) {
    const Region* region = c.view.selected_region();
    if (!region) return;
    FormToolState& s = c.state.form;
    if (s.region != region->id) {
        s.region = region->id;
        s.parallel.reset();
        s.from.reset();
    }
    // Shapes lie on the reference frame; elsewhere the surface has moved on.
    if (const auto reference = reference_of(c, *region); reference && *reference != c.view.frame)
        return;
    if (s.from) return draw_new_guide(c, map, *region);
    if (!any_handle_held(c)) {
        s.shape = region->form.shape;
        s.strokes = region->form.strokes;
    }
    Touched all;
    for (std::vector<FormGuide>* guides : {&s.shape, &s.strokes}) {
        for (std::size_t k = 0; k < guides->size(); ++k) {
            const Touched now = drag_guide_handles(c, map, hovered, k, (*guides)[k]);
            all.over |= now.over;
            all.done |= now.done;
            if (!now.removed) continue;
            if (guides == &s.shape)
                s.shape.clear();
            else
                remove_line(k, *now.removed / 2, s.strokes);
            return set_form(c, *region);
        }
    }
    show_problem(c, map, s);
    if (s.parallel) draw_lines(c, map, *s.parallel, c.theme.warn);
    if (all.done) return set_form(c, *region);
    if (all.over || any_handle_held(c) || !active || !ImGui::IsMouseClicked(0)) return;
    s.from = map.to_plate(ImGui::GetIO().MousePos);
}

}  // namespace weft::ui

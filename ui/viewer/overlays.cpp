// Overlays: mattes, and diagnostics with legends.
#include "ui/viewer/overlays.h"

#include <algorithm>
#include <cmath>

#include "ui/base/icons.h"
#include "ui/viewer/compare.h"
#include "ui/viewer/normals_view.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {

void picture_pill(Ctx& c, ImDrawList& list, ImVec2 at, const std::string& text, ImU32 color,
                  const char* icon) {
    const Theme& t = c.theme;
    const float w = t.small->CalcTextSizeA(t.small->FontSize, FLT_MAX, 0, text.c_str()).x +
                    t.px(16) + (icon ? t.px(16) : 0);
    const ImVec2 max(at.x + w, at.y + t.px(22));
    list.AddRectFilled(at, max, t.scrim, t.radius);
    if (icon) icon_in(c, list, {at.x + t.px(3), at.y}, {at.x + t.px(21), max.y}, color, icon);
    text_in(list, t.small, {at.x + t.px(icon ? 24 : 8), at.y}, max, color, text.c_str(), 0);
}

// Drawn over the whole plate. `key`: of its texture.
static MatteDraw over_plate(const Ctx& c, const ViewMap& map, const RegionMatteView& matte,
                            std::uint64_t key) {
    MatteDraw draw;
    draw.pixels = matte.pixels;
    draw.key = key;
    draw.version = matte.version;
    draw.changed = matte.changed;
    draw.min = map.to_screen({0, 0});
    draw.max = map.to_screen({static_cast<float>(c.view.plate.size.width),
                              static_cast<float>(c.view.plate.size.height)});
    draw.clip_min = map.min;
    draw.clip_max = map.max;
    return draw;
}

// Holdouts or zones of the selected region.
static void draw_layers(Ctx& c, ImDrawList& list, const ViewMap& map,
                        const std::vector<RegionMatteView>& layers, ImU32 color) {
    const SessionView& v = c.view;
    for (const RegionMatteView& layer : layers) {
        if (layer.pixels.empty()) continue;
        constexpr std::uint64_t kHoldouts = 2'000'000, kZones = 3'000'000;  // beyond the regions
        const std::uint64_t key =
            is_zone_layer(layer.layer)
                ? kZones + static_cast<std::uint64_t>(zone_of_layer(layer.layer))
                : kHoldouts + static_cast<std::uint64_t>(layer.layer);
        MatteDraw draw = over_plate(c, map, layer, key);
        draw.color = color;
        draw.outline = layer.layer == v.matte_layer;
        draw.opacity = draw.outline ? 0.45f : 0.22f;
        c.pictures.draw(list, draw);
    }
}

// The keyframes on both sides: the earlier one in blue, the later one in amber.
static void draw_onion(Ctx& c, ImDrawList& list, const ViewMap& map) {
    for (const RegionMatteView& key : c.view.onion) {
        if (key.pixels.empty()) continue;
        const bool before = key.frame < c.view.frame;
        // Beyond the regions, holdouts and zones.
        MatteDraw draw = over_plate(c, map, key, before ? 4'000'000 : 4'000'001);
        draw.color = before ? c.theme.accent_hover : c.theme.warn;
        draw.opacity = 0.1f;
        draw.outline = true;
        c.pictures.draw(list, draw);
    }
}

// What is confirmed of the painted matte on this frame.
static void draw_confirmed(Ctx& c, ImDrawList& list, const ViewMap& map) {
    const RegionMatteView& area = c.view.confirmed;
    if (area.pixels.empty()) return;
    MatteDraw draw = over_plate(c, map, area, 4'000'002);  // beyond the keyframes
    draw.color = c.theme.good;
    draw.opacity = c.state.tool == Tool::kConfirm ? 0.3f : 0.15f;
    draw.outline = false;
    c.pictures.draw(list, draw);
}

// In the Motion workspace zones show while one is painted.
static bool paints_motion_zone(const Ctx& c) {
    return c.state.workspace == Workspace::kMotion && is_zone_layer(c.view.matte_layer);
}

void draw_mattes(Ctx& c, ImDrawList& list, const ViewMap& map) {
    const SessionView& v = c.view;
    // No outline in Review, where it would disturb judging the edge.
    if (c.state.workspace == Workspace::kReview) return;
    const bool in_mask = c.state.workspace == Workspace::kMask;
    for (const RegionMatteView& matte : v.mattes) {
        const Region* region = region_by_id(v.project, matte.region);
        if (!region || matte.pixels.empty()) continue;
        if (v.solo != 0 && v.solo != matte.region) continue;
        const bool selected = matte.region == v.selected;
        if (!in_mask && !selected) continue;
        MatteDraw draw = over_plate(c, map, matte, matte.region);
        draw.color = region_color(region->color, region->id);
        // Only the outline while working on the texture, because a coloured matte would falsify
        // colours.
        // Other regions stay as faint beside the selected one as they are by default.
        const auto opacity = static_cast<float>(std::clamp(c.settings.matte_opacity, 0.0, 1.0));
        draw.opacity = !in_mask ? 0.0f : selected ? opacity : 0.37f * opacity;
        draw.outline = selected;
        c.pictures.draw(list, draw);
    }
    // Holdouts are red, because they are cut out; zones are white, unlike any region.
    if (in_mask || paints_motion_zone(c)) draw_layers(c, list, map, v.zones, IM_COL32_WHITE);
    if (!in_mask) return;
    draw_layers(c, list, map, v.holdouts, c.theme.bad);
    draw_confirmed(c, list, map);
    draw_onion(c, list, map);
}

bool paints_over_plate(const Ctx& c) {
    return c.state.workspace == Workspace::kMask && c.state.tool != Tool::kPan &&
           c.state.viewer.compare == Compare::kResult && !c.view.layer;
}

void draw_matte_state(Ctx& c, ImDrawList& list, ImVec2 at) {
    const SessionView& v = c.view;
    if (c.state.workspace != Workspace::kMask && !paints_motion_zone(c)) return;
    const std::vector<RegionMatteView>& layers = v.matte_layer == 0  ? v.mattes
                                                 : v.matte_layer > 0 ? v.holdouts
                                                                     : v.zones;
    const auto painted = std::find_if(layers.begin(), layers.end(), [&](const auto& matte) {
        return matte.region == v.selected && matte.layer == v.matte_layer;
    });
    if (painted == layers.end()) return;
    const bool unreached = painted->kind == RegionMatteView::Kind::kUnreached;
    if (!unreached && !painted->outdated) return;
    std::string text =
        unreached ? "The matte has not reached this frame" : "Matte before the last change";
    text += v.analysis_paused ? "  ·  analysis paused" : "  ·  propagating…";
    picture_pill(c, list, at, text, c.theme.warn,
                 v.analysis_paused ? icons::kPause : icons::kTimer);
    c.note("Matte state: " + text);
}

// Of a value, as a heat map with a legend.
static bool has_scale(Overlay kind) {
    return kind != Overlay::kGrid && kind != Overlay::kSourceMap && kind != Overlay::kChecker &&
           kind != Overlay::kCircles;
}

void draw_overlay(Ctx& c, ImDrawList& list, const ViewMap& map) {
    const auto& over = c.view.overlay_picture;
    if (!over) return;
    if (over->kind == Overlay::kNormals) return draw_normals_overlay(c, list, map, *over);
    const Theme& t = c.theme;
    MatteDraw draw;
    draw.pixels = over->value;
    draw.where = over->where;
    draw.key = 1'000'000;
    draw.version = over->id;
    draw.heat = has_scale(over->kind);
    draw.color = t.text;
    draw.opacity = over->kind == Overlay::kSeams       ? 1.0f
                   : over->kind == Overlay::kSourceMap ? 0.4f
                                                       : 0.75f;
    draw.min = map.to_screen({0, 0});
    draw.max = map.to_screen(
        {static_cast<float>(over->value.width()), static_cast<float>(over->value.height())});
    draw.clip_min = map.min;
    draw.clip_max = map.max;
    if (over->kind != Overlay::kMotion) {
        c.pictures.draw(list, draw);
        if (over->marked.empty()) return;
        // Locked and regenerated patches.
        MatteDraw kept = draw;
        kept.pixels = over->marked;
        kept.where = {};
        kept.key = 1'000'001;
        kept.heat = false;
        kept.color = t.accent_hover;
        kept.opacity = 0.5f;
        kept.outline = true;
        c.pictures.draw(list, kept);
        return;
    }
    list.PushClipRect(map.min, map.max, true);
    for (const auto& arrow : over->arrows) {
        const ImVec2 from = map.to_screen(arrow.to), to = map.to_screen(arrow.at);
        const float dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
        list.AddLine(from, to, IM_COL32(0, 0, 0, 160), t.px(3));
        list.AddLine(from, to, t.warn, t.px(1.5f));
        if (length < t.px(5)) {
            list.AddCircleFilled(to, t.px(2), t.warn, 8);
            continue;
        }
        const float ux = dx / length, uy = dy / length, h = t.px(5);
        list.AddTriangleFilled(to, {to.x - h * ux - 0.6f * h * uy, to.y - h * uy + 0.6f * h * ux},
                               {to.x - h * ux + 0.6f * h * uy, to.y - h * uy - 0.6f * h * ux},
                               t.warn);
    }
    list.PopClipRect();
}

// The legend of a heat map.
void draw_legend(Ctx& c, ImDrawList& list, ImVec2 min, ImVec2 max) {
    const auto& over = c.view.overlay_picture;
    const Theme& t = c.theme;
    if (c.view.overlay == Overlay::kNone) return;
    if (c.view.overlay == Overlay::kNormals) {
        const bool shows = over && over->kind == Overlay::kNormals;
        return draw_normals_legend(c, list, min, max, shows ? &*over : nullptr);
    }
    static constexpr const char* kNames[] = {"",
                                             "Texture grid",
                                             "Stretch",
                                             "Shading",
                                             "Seams",
                                             "Motion arrows",
                                             "Tracking confidence",
                                             "Source map",
                                             "Checker",
                                             "Circles",
                                             "Light confidence"};
    const std::string name = kNames[static_cast<int>(c.view.overlay)];
    const bool scale = over && has_scale(over->kind) && over->kind != Overlay::kMotion;
    const float w = t.px(220), h = scale ? t.px(52) : t.px(26);
    const ImVec2 a(max.x - w - t.px(10), min.y + t.px(10)),
        b(max.x - t.px(10), min.y + t.px(10) + h);
    list.AddRectFilled(a, b, t.scrim, t.radius);
    text_in(
        list, t.small, {a.x + t.px(8), a.y}, {b.x, a.y + t.px(24)}, t.text,
        (name + (over ? (over->unit.empty() ? "" : ", " + over->unit) : ": Rendering…")).c_str(),
        0);
    if (h < t.px(40)) return;
    constexpr int kSteps = 48;
    const float x0 = a.x + t.px(8), x1 = b.x - t.px(8);
    for (int k = 0; k < kSteps; ++k) {
        const float u0 = static_cast<float>(k) / kSteps, u1 = static_cast<float>(k + 1) / kSteps;
        list.AddRectFilled({x0 + u0 * (x1 - x0), a.y + t.px(24)},
                           {x0 + u1 * (x1 - x0) + 0.5f, a.y + t.px(32)}, heat_color(u0));
    }
    text_in(list, t.small, {x0, a.y + t.px(32)}, {x1, b.y}, t.quiet,
            number_text(static_cast<double>(over->low), 0).c_str(), 0);
    text_in(list, t.small, {x0, a.y + t.px(32)}, {x1, b.y}, t.quiet,
            number_text(static_cast<double>(over->high), 0).c_str(), 1);
}

// The provenance of the pixel under the mouse.
void draw_provenance(Ctx& c, ImDrawList& list, const ViewMap& map, bool hovered) {
    c.state.viewer.provenance.clear();
    const auto& over = c.view.overlay_picture;
    if (!hovered || !over || !over->provenance || !c.state.viewer.pixel) return;
    const Vec2i at = *c.state.viewer.pixel;
    if (!rect_of(over->where.size()).contains(at.x, at.y) || over->where.at(at.x, at.y) == 0)
        return;
    const Provenance& from = *over->provenance;
    const Vec2 p(static_cast<float>(at.x) + 0.5f, static_cast<float>(at.y) + 0.5f);
    const Provenance::Answer found = from.at(p);
    const auto pair = [](double x, double y) {
        return number_text(std::floor(x), 0) + ", " + number_text(std::floor(y), 0);
    };
    std::vector<std::string> lines{found.sample};
    if (!found.sample_id.empty()) lines.push_back("Texture " + found.sample_id);
    if (found.in_sample)
        lines.push_back((found.patch ? "Patch " + std::to_string(*found.patch) + ", sample at "
                                     : std::string("Sample at ")) +
                        pair(found.in_sample->x, found.in_sample->y));
    else
        lines.push_back("Texel " + pair(static_cast<double>(found.texel.x),
                                        static_cast<double>(found.texel.y)));
    const std::string seam = found.seam_between
                                 ? "Seam " + std::to_string(found.seam_between->first) + "|" +
                                       std::to_string(found.seam_between->second)
                                 : std::string("On a seam");
    lines.push_back(found.seam ? seam + ", difference " + std::to_string(*found.seam)
                               : "Inside a patch");
    if (const auto& marked = over->marked; !marked.empty() && marked.at(at.x, at.y) != 0)
        lines.push_back(marked.at(at.x, at.y) == 255 ? "Locked" : "Regenerated");
    if (found.light)
        lines.push_back("Shading × " + number_text(static_cast<double>(*found.light), 2));
    lines.push_back(
        "From " +
        pair(static_cast<double>(found.on_reference.x), static_cast<double>(found.on_reference.y)) +
        " on frame " + std::to_string(from.reference_frame));
    for (const Provenance::Answer::Share& share : found.tracks)
        lines.push_back("Track from frame " + std::to_string(share.frame) + ", weight " +
                        number_text(static_cast<double>(share.weight), 2));
    if (found.made_anew > 0)
        lines.push_back("Synthesized here, weight " +
                        number_text(static_cast<double>(found.made_anew), 2));
    c.state.viewer.provenance = lines;
    const Theme& t = c.theme;
    float w = 0;
    for (const std::string& line : lines)
        w = std::max(w, t.small->CalcTextSizeA(t.small->FontSize, FLT_MAX, 0, line.c_str()).x);
    const float row = t.px(17), h = row * static_cast<float>(lines.size()) + t.px(10);
    w += t.px(18);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    // Beside the mouse, where there is room.
    const float x =
        mouse.x + t.px(18) + w < map.max.x ? mouse.x + t.px(18) : mouse.x - t.px(18) - w;
    const float y = std::clamp(mouse.y + t.px(14), map.min.y, std::max(map.min.y, map.max.y - h));
    list.AddRectFilled({x, y}, {x + w, y + h}, t.scrim, t.radius);
    for (std::size_t k = 0; k < lines.size(); ++k) {
        const float top = y + t.px(5) + row * static_cast<float>(k);
        text_in(list, t.small, {x + t.px(9), top}, {x + w, top + row}, k == 0 ? t.text : t.quiet,
                lines[k].c_str(), 0);
    }
}

}  // namespace weft::ui

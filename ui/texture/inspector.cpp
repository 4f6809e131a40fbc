// Texture workspace: the texture and its placement.
#include <algorithm>
#include <cmath>

#include "ui/base/icons.h"
#include "ui/form/form.h"
#include "ui/parameters/parameters.h"
#include "ui/placement/placement.h"
#include "ui/texture/parts.h"
#include "ui/texture/texture.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

// Above this magnification single texels are visible.
constexpr double kMostMagnified = 1.5;

void magnified_warning(Ctx& c, const Region& region) {
    double scale = region.placement.scale;
    const KeyedNumbers& keys = region.placement.scale_keys;
    if (!keys.empty()) scale = keys.at(c.view.frame)[0];
    if (scale <= kMostMagnified) return;
    // A library texture may have a larger original.
    TextureCard card;
    card.path = library_name_of(region.texture.sample);
    if (!card.path.empty()) card = c.textures.details(card);
    const bool larger =
        card.original_scale > 1 && region.texture.sample.find("_larger.") == std::string::npos;
    banner(c, icons::kMagnify, c.theme.warn,
           "Magnified " + number_text(scale, 1) + " times: it will look soft." +
               (larger ? "" : " Use a larger picture."));
    if (larger &&
        button(c,
               ("Use original, " + number_text(static_cast<double>(card.original_scale), 1) +
                " times larger##larger")
                   .c_str(),
               {.icon = icons::kGrowing,
                .look = Look::kPrimary,
                .tip = "Synthesizes from the larger picture that the sample was cut from; its "
                       "size on the surface stays the same",
                .width = -1}))
        c.emit(UseLargerOriginal{region.id});
    if (larger) c.note("Use original");
}

void bricks_controls(Ctx& c) {
    if (c.state.tool != Tool::kMeasure) {
        if (button(c, "Scale by reference line",
                   {.icon = icons::kRuler,
                    .tip = "Draw a line along a row of bricks or tiles on the plate and enter how "
                           "many repeats it covers",
                    .command = "tool.measure",
                    .width = -1}))
            c.state.tool = Tool::kMeasure;
        return;
    }
    if (!c.state.measured) {
        wrapped(c, "Draw a line on the picture along a row of bricks, tiles or stitches.",
                c.theme.quiet);
        return;
    }
    double count = c.state.measured_count;
    if (slider(c,
               {.label = "Repeats",
                .tip = "How many bricks, tiles or stitches lie along the line",
                .min = 1,
                .max = 40,
                .standard = 4,
                .decimals = 0,
                .integer = true,
                .typed_min = 1,
                .typed_max = 1000},
               count) != Change::kNone)
        c.state.measured_count = static_cast<int>(count);
    if (button(c, "Scale to fit##bricks",
               {.icon = icons::kRuler, .look = Look::kPrimary, .width = -1}))
        c.emit(ScaleByLine{c.state.measured->first, c.state.measured->second,
                           static_cast<double>(c.state.measured_count)});
}

// On the plane that was found, else around the region, else in the middle of the plate.
std::vector<double> first_corners(Ctx& c, RegionId region) {
    const auto found = c.view.preview.planes.find(region);
    if (found != c.view.preview.planes.end()) return numbers_of(found->second);
    const double w = c.view.plate.size.width, h = c.view.plate.size.height;
    const auto box = corners_around_region(c);
    if (!box) return {0.3 * w, 0.3 * h, 0.7 * w, 0.3 * h, 0.7 * w, 0.7 * h, 0.3 * w, 0.7 * h};
    return numbers_of(*box);
}

// Pins begin on the plane that was found, and say so.
void add_pins(Ctx& c, const Region& region) {
    const auto& view = c.view.preview;
    auto& said = c.state.form.pinned_on;
    said.erase(region.id);
    if (const auto text = view.forms.find(region.id);
        text != view.forms.end() && view.planes.contains(region.id))
        said[region.id] = text->second;
    c.edit(
        SetRegionParameter{{region.id, {}}, "placement.corners_px", first_corners(c, region.id)});
    c.state.tool = Tool::kPlace;
}

void perspective_section(Ctx& c, const Region& region) {
    if (!section(c, "Perspective", false)) return;
    const PanelName panel(c, "Perspective");
    region_parameter(c, region, "placement.corners_px", "Corners");
    const bool set = region.placement.corners_px.has_value();
    if (!set && button(c, "Add corner pin",
                       {.icon = icons::kCrosshairs,
                        .enabled = !c.view.plate.size.empty(),
                        .tip = "Adds four corners to drag onto a flat surface in perspective. They "
                               "begin on the plane that was found, if there is one",
                        .width = -1}))
        add_pins(c, region);
    if (set && button(c, "Remove corner pin", {.icon = icons::kClose, .width = -1}))
        c.edit(SetRegionParameter{{region.id, {}}, "placement.corners_px", {}});
    section_gap(c);
}

}  // namespace

void texture_inspector(Ctx& c) {
    const Region* region = c.view.selected_region();
    if (!region) return no_region(c);
    const Theme& t = c.theme;
    if (section(c, "Texture")) {
        const PanelName panel(c, "Texture");
        const bool plane = !region->texture.plane.empty();
        const std::string& path = plane ? region->texture.plane : region->texture.sample;
        if (path.empty()) {
            banner(c, icons::kTexture, t.accent,
                   "Double-click a texture in the drawer below, or drag one onto the surface.");
        } else {
            const PicturePtr thumb = c.textures.thumbnail(
                path.starts_with('/')
                    ? path
                    : c.view.path.substr(0, c.view.path.find_last_of('/') + 1) + path,
                static_cast<int>(t.px(96)));
            const ImVec2 at = ImGui::GetCursorScreenPos();
            const float side = t.px(64);
            ImDrawList& list = *ImGui::GetWindowDrawList();
            list.AddRectFilled(at, {at.x + side, at.y + side}, t.field, t.radius);
            if (thumb)
                if (const ImTextureID id = c.pictures.texture(thumb))
                    list.AddImageRounded(id, at, {at.x + side, at.y + side}, {0, 0}, {1, 1},
                                         IM_COL32_WHITE, t.radius);
            const float x = at.x + side + t.px(10);
            const float right = at.x + ImGui::GetContentRegionAvail().x;
            text_in(list, t.strong, {x, at.y + t.px(4)}, {right, at.y + t.px(24)}, t.text,
                    fitted(c.textures.name_of_texture(path), right - x).c_str(), 0);
            text_in(list, t.small, {x, at.y + t.px(24)}, {right, at.y + t.px(42)}, t.quiet,
                    plane || shows_sample(region->texture.mode) ? "Not synthesized" : "Synthesized",
                    0);
            ImGui::Dummy({side, side});
            if (plane) {
                if (button(c, "Use as a sample",
                           {.icon = icons::kTexture,
                            .tip = "Synthesize, tile, stretch or mirror this image instead of "
                                   "showing it as a finished plane",
                            .width = -1})) {
                    TextureSource source = region->texture;
                    source.sample = std::exchange(source.plane, {});
                    c.edit(SetTexture{{region->id, {}}, source});
                }
                region_parameter(c, *region, "texture.wrap", "Wrap mode");
            } else {
                region_parameter(c, *region, "texture.mode", "Mode");
                // Known a moment after the texture: its lines are kept, so that nothing moves.
                const auto kind = c.view.preview.samples.find(region->id);
                wrapped_in(c,
                           kind != c.view.preview.samples.end() ? "Taken for " + kind->second + "."
                                                                : std::string(),
                           t.quiet, 3);
            }
        }
        flat_controls(c, *region);
        section_gap(c);
    }
    if (section(c, "Placement")) {
        const PanelName panel(c, "Placement");
        keyed_parameter(c, *region, "placement.scale", "placement.scale_keys");
        keyed_parameter(c, *region, "placement.rotate_deg", "placement.rotate_keys");
        keyed_parameter(c, *region, "placement.offset_px", "placement.offset_keys", "Offset");
        // Below what can be dragged, which would jump from under the mouse.
        magnified_warning(c, *region);
        if (button(c, "Transform",
                   {.icon = icons::kMove,
                    .tip = "Drag inside the box to move the texture, its corners to scale it, "
                           "outside of it to rotate it. Both turn about the pivot. Arrow keys "
                           "nudge",
                    .command = "tool.place",
                    .width = -1}))
            c.state.tool = Tool::kPlace;
        bricks_controls(c);
        section_gap(c);
    }
    form_section(c, *region);
    warp_section(c, *region);
    provenance_section(c, *region);
    perspective_section(c, *region);
}

}  // namespace weft::ui

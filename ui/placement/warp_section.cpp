// Texture workspace: the grid warp, its size, fall-off and keys.
#include <algorithm>

#include "ui/base/icons.h"
#include "ui/placement/placement.h"
#include "ui/placement/warp_grid.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

void set_warp(Ctx& c, const Region& region, GridWarp warp) {
    c.emit(DoEdits{{edit_of_warp(region, std::move(warp))}, "Warp texture"});
}

void size_controls(Ctx& c, const Region& region, const GridWarp& warp) {
    const auto row = [&](const char* label, const char* tip, int now) -> std::optional<int> {
        double value = now;
        const Change change = slider(c,
                                     {.label = label,
                                      .tip = tip,
                                      .min = 1,
                                      .max = GridWarp::kMostPatches,
                                      .standard = 3,
                                      .decimals = 0,
                                      .integer = true},
                                     value);
        // Only the last of the numbers dragged over: each resampling loses a little.
        if (change != Change::kDone || static_cast<int>(value) == now) return std::nullopt;
        return static_cast<int>(value);
    };
    const auto columns = row("Columns", "Patches across; the warp is kept", warp.columns);
    const auto rows = row("Rows", "Patches down; the warp is kept", warp.rows);
    if (!columns && !rows) return;
    GridWarp finer = resampled(warp, columns.value_or(warp.columns), rows.value_or(warp.rows));
    if (!check_grid_warp(finer)) return;
    c.state.warp.selected.clear();
    set_warp(c, region, std::move(finer));
}

void falloff_control(Ctx& c, const Region& region, GridWarp warp) {
    double value = warp.falloff_px;
    const Change change =
        slider(c,
               {.label = "Fall-off",
                .unit = "px",
                .tip = "Beyond the border of the grid the warp fades over so many "
                       "plate pixels; 0: it continues",
                .min = 0,
                .max = 500,
                .standard = 0,
                .decimals = 0,
                .typed_min = 0,
                .typed_max = GridWarp::kMostPx},
               value);
    if (change == Change::kNone) return;
    warp.falloff_px = value;
    if (!check_grid_warp(warp)) return;
    if (change == Change::kDone)
        set_warp(c, region, std::move(warp));
    else
        c.emit(TryEdits{{edit_of_warp(region, std::move(warp))}});
}

void key_controls(Ctx& c, const Region& region, GridWarp warp) {
    const int frame = c.view.frame;
    const auto at = std::find_if(warp.keys.begin(), warp.keys.end(),
                                 [&](const auto& key) { return key.first == frame; });
    const bool here = at != warp.keys.end();
    if (button(c, here ? "Remove key##warp" : "Key here##warp",
               {.icon = icons::kKeyframe,
                .tip = here ? "Removes the key of the grid on this frame"
                            : "Keys all points of the grid on this frame; between keys they move "
                              "evenly",
                .width = -1})) {
        if (!here) {
            set_key(warp, frame, points_on(warp, frame));
        } else {
            // Without keys the grid stays as it is here.
            if (warp.keys.size() == 1) warp.points = at->second;
            warp.keys.erase(at);
        }
        set_warp(c, region, std::move(warp));
        return;
    }
    if (warp.keys.empty()) return;
    std::string frames;
    for (const auto& [number, points] : warp.keys)
        frames += (frames.empty() ? "" : ", ") + std::to_string(number);
    info_row(c, "Keys", frames, "Frames on which the grid is keyed");
}

}  // namespace

void warp_section(Ctx& c, const Region& region) {
    if (!section(c, "Grid warp")) return;
    const PanelName panel(c, "Warp");
    const bool in_hand = c.state.tool == Tool::kWarp;
    if (button(c, "Warp by a grid",
               {.icon = icons::kGridWarp,
                .look = in_hand ? Look::kPrimary : Look::kNormal,
                .tip = "Drag points and handles of a grid over the region. Shift or a box selects "
                       "several, arrow keys nudge them",
                .command = "tool.warp",
                .width = -1}))
        c.state.tool = Tool::kWarp;
    const auto warp = in_hand ? warp_shown(c, region) : region.placement.warp;
    if (warp) {
        size_controls(c, region, *warp);
        falloff_control(c, region, *warp);
        key_controls(c, region, *warp);
        if (in_hand && !c.state.warp.selected.empty() &&
            button(c, "Smooth points",
                   {.icon = icons::kCurve,
                    .tip = "Handles of the selected points follow from their neighbours again",
                    .width = -1}))
            set_warp(c, region, with_smooth_points(*warp, c.view.frame, c.state.warp.selected));
        if (region.placement.warp &&
            button(c, "Reset warp", {.icon = icons::kClose, .width = -1})) {
            c.state.warp.selected.clear();
            c.emit(DoEdits{{edit_of_warp(region, std::nullopt)}, "Reset warp"});
        }
    } else if (in_hand) {
        wrapped(c, "Paint the region first, or add a corner pin: the grid is laid over it.",
                c.theme.quiet);
    }
    section_gap(c);
}

}  // namespace weft::ui

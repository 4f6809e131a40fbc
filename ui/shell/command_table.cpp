#include "ui/shell/command_table.h"

#include <algorithm>

#include "app/base/next_region.h"
#include "app/project/region_names.h"
#include "ui/base/commands.h"
#include "ui/base/ctx.h"
#include "ui/base/icons.h"
#include "ui/motion/motion.h"
#include "ui/shell/command_parts.h"
#include "ui/viewer/compare.h"

namespace weft {
namespace {

bool has_plate(const Ctx& c) {
    return c.view.open && c.view.plate.state == PlateView::State::kOpen;
}
bool has_region(const Ctx& c) {
    return c.view.selected_region() != nullptr;
}

void compare(Ctx& c, Compare wanted) {
    Compare& now = c.state.viewer.compare;
    now = now == wanted ? Compare::kResult : wanted;
    c.emit(ShowStages{now == Compare::kFourUp});
}

void overlay(Ctx& c, Overlay wanted) {
    c.emit(ShowOverlay{c.view.overlay == wanted ? Overlay::kNone : wanted});
}

void channel(Ctx& c, DisplaySettings::Channel wanted) {
    auto& now = c.state.viewer.display.channel;
    now = now == wanted ? DisplaySettings::Channel::kColor : wanted;
}

void add_region(Ctx& c) {
    c.edit(AddRegion{next_region(c.view.project), {}});
    // What it needs first is a matte.
    set_workspace(c.state, Workspace::kMask);
    if (c.state.tool == Tool::kPan) c.state.tool = Tool::kBrush;
}

void add_edit_commands(std::vector<Command>& out) {
    out.push_back(command(
        "edit.undo", "Edit", "Undo", icons::kUndo, "Ctrl+Z", [](Ctx& c) { c.emit(Undo{}); },
        [](const Ctx& c) { return !c.view.undo_label.empty(); }));
    out.back().repeats = true;
    out.push_back(command(
        "edit.redo", "Edit", "Redo", icons::kRedo, "Ctrl+Shift+Z", [](Ctx& c) { c.emit(Redo{}); },
        [](const Ctx& c) { return !c.view.redo_label.empty(); }));
    out.back().repeats = true;
    out.push_back(command(
        "edit.history", "Edit", "History…", icons::kHistory, "Ctrl+H",
        [](Ctx& c) { c.state.history_open = !c.state.history_open; }, is_open));
    out.push_back(command("edit.palette", "Edit", "Find a command…", icons::kMagnify,
                          "Ctrl+Shift+P", [](Ctx& c) {
                              c.state.palette_open = true;
                              c.state.palette_text.clear();
                              c.state.palette_at = 0;
                          }));
    out.push_back(command(
        "edit.shot", "Edit", "Shot settings…", icons::kFilm, "Ctrl+Shift+E",
        [](Ctx& c) { c.state.shot_open = !c.state.shot_open; }, is_open));
    out.push_back(command("edit.settings", "Edit", "Settings…", icons::kSettings, "Ctrl+,",
                          [](Ctx& c) { c.state.settings_open = !c.state.settings_open; }));
}

// Channels, exposure and gamma of the view.
void add_display_commands(std::vector<Command>& out) {
    using Channel = DisplaySettings::Channel;
    const auto add_channel = [&](const char* id, const char* name, const char* key, Channel which) {
        out.push_back(command(
            id, "View", name, "", key, [which](Ctx& c) { channel(c, which); }, {},
            [which](const Ctx& c) { return c.state.viewer.display.channel == which; }));
    };
    add_channel("view.color", "All channels", "C", Channel::kColor);
    add_channel("view.red", "Red channel", "Shift+R", Channel::kRed);
    add_channel("view.green", "Green channel", "Shift+G", Channel::kGreen);
    add_channel("view.blue", "Blue channel", "Shift+B", Channel::kBlue);
    add_channel("view.luma", "Brightness", "Shift+Y", Channel::kLuma);
    const auto add_step = [&](const char* id, const char* name, const char* key, auto change) {
        out.push_back(command(id, "View", name, "", key,
                              [change](Ctx& c) { change(c.state.viewer.display); }));
        out.back().repeats = true;
    };
    add_step("view.darker", "Exposure down", ",", [](DisplaySettings& d) { d.exposure -= 0.25f; });
    add_step("view.brighter", "Exposure up", ".", [](DisplaySettings& d) { d.exposure += 0.25f; });
    add_step("view.gamma_down", "Gamma down", "Shift+9",
             [](DisplaySettings& d) { d.gamma = std::max(0.2f, d.gamma - 0.1f); });
    add_step("view.gamma_up", "Gamma up", "Shift+0",
             [](DisplaySettings& d) { d.gamma = std::min(4.0f, d.gamma + 0.1f); });
    out.push_back(command("view.reset", "View", "Reset display", icons::kRefresh, "Ctrl+R",
                          [](Ctx& c) { c.state.viewer.display = {}; }));
}

void add_view_commands(std::vector<Command>& out) {
    const auto workspace = [](Workspace w) { return [w](Ctx& c) { set_workspace(c.state, w); }; };
    const char* const keys[] = {"F5", "F6", "F7", "F8", "F9", "F10"};
    const char* const glyphs[] = {icons::kBrush, icons::kTexture, icons::kMotion,
                                  icons::kLight, icons::kReview,  icons::kJobs};
    static const char* const ids[] = {"workspace.mask",  "workspace.texture", "workspace.motion",
                                      "workspace.light", "workspace.review",  "workspace.jobs"};
    for (int k = 0; k < kWorkspaceCount; ++k) {
        const auto w = static_cast<Workspace>(k);
        out.push_back(command(ids[k], "View", workspace_name(w), glyphs[k], keys[k], workspace(w)));
    }
    out.push_back(command("view.fit", "View", "Fit to window", icons::kFullscreen, "F",
                          [](Ctx& c) { c.state.viewer.fit = true; }));
    out.push_back(command("view.actual", "View", "100%", icons::kMagnify, "Ctrl+1", [](Ctx& c) {
        c.state.viewer.fit = false;
        c.state.viewer.zoom = 1;
    }));
    out.push_back(command(
        "view.squeezed", "View", "Squeezed pixels", icons::kGrid, "",
        [](Ctx& c) { c.state.viewer.squeezed = !c.state.viewer.squeezed; },
        [](const Ctx& c) { return c.view.plate.pixel_aspect != 1; },
        [](const Ctx& c) { return c.state.viewer.squeezed; }));
    out.push_back(command(
        "view.plate", "View", "Show plate", icons::kImage, "T",
        [](Ctx& c) { compare(c, Compare::kPlate); }, {},
        [](const Ctx& c) { return c.state.viewer.compare == Compare::kPlate; }));
    out.push_back(command(
        "view.wipe", "View", "Wipe", icons::kWipe, "W", [](Ctx& c) { compare(c, Compare::kWipe); },
        {}, [](const Ctx& c) { return c.state.viewer.compare == Compare::kWipe; }));
    out.push_back(command(
        "view.difference", "View", "Difference", icons::kDifference, "D",
        [](Ctx& c) { compare(c, Compare::kDifference); }, {},
        [](const Ctx& c) { return c.state.viewer.compare == Compare::kDifference; }));
    out.push_back(command(
        "view.side", "View", "Side by side", icons::kSideBySide, "Shift+W",
        [](Ctx& c) { compare(c, Compare::kSideBySide); }, {},
        [](const Ctx& c) { return c.state.viewer.compare == Compare::kSideBySide; }));
    out.push_back(command(
        "view.four", "View", "Four up", icons::kFourUp, "4",
        [](Ctx& c) { compare(c, Compare::kFourUp); }, {},
        [](const Ctx& c) { return c.state.viewer.compare == Compare::kFourUp; }));
    out.push_back(command("view.store", "View", "Store result for comparison", icons::kCompare,
                          "Shift+A", ui::store_result,
                          [](const Ctx& c) { return c.view.result_picture != nullptr; }));
    out.push_back(command(
        "view.onion", "View", "Onion skin", icons::kLayers, "Shift+O",
        [](Ctx& c) { c.emit(ShowOnionSkin{!c.view.onion_skin}); }, has_region,
        [](const Ctx& c) { return c.view.onion_skin; }));
    out.push_back(command(
        "view.mattes", "View", "Mattes", icons::kMask, "M",
        [](Ctx& c) { c.state.viewer.mattes_shown = !c.state.viewer.mattes_shown; }, {},
        [](const Ctx& c) { return c.state.viewer.mattes_shown; }));
    const auto add_overlay = [&](const char* id, const char* name, const char* icon,
                                 const char* key, Overlay which) {
        out.push_back(command(
            id, "View", name, icon, key, [which](Ctx& c) { overlay(c, which); }, has_region,
            [which](const Ctx& c) { return c.view.overlay == which; }));
    };
    add_overlay("view.seams", "Seams", icons::kSeam, "X", Overlay::kSeams);
    add_overlay("view.light", "Shading", icons::kLight, "H", Overlay::kLight);
    add_overlay("view.grid", "Texture grid", icons::kGrid, "G", Overlay::kGrid);
    add_overlay("view.stretch", "Stretch", icons::kScale, "S", Overlay::kStretch);
    add_overlay("view.arrows", "Motion arrows", icons::kMotion, "V", Overlay::kMotion);
    add_overlay("view.trust", "Tracking confidence", icons::kAlert, "Shift+T",
                Overlay::kConfidence);
    add_overlay("view.pieces", "Source map", icons::kCrosshairs, "Shift+X", Overlay::kSourceMap);
    add_overlay("view.checker", "Checker on the surface", icons::kForm, "Shift+V",
                Overlay::kChecker);
    add_overlay("view.circles", "Circles on the surface", icons::kCircleOutline, "Shift+H",
                Overlay::kCircles);
    add_overlay("view.light_confidence", "Light confidence", icons::kLight, "",
                Overlay::kLightConfidence);
    add_overlay("view.normals", "Normals of the form", icons::kForm, "Shift+J", Overlay::kNormals);
    add_display_commands(out);
    out.push_back(command(
        "view.panels", "View", "Hide all panels", "", "Tab",
        [](Ctx& c) { c.state.panels_hidden = !c.state.panels_hidden; }, {},
        [](const Ctx& c) { return c.state.panels_hidden; }));
    out.push_back(command("view.second", "View", "Second window", icons::kOpenInNew, "Shift+F11",
                          [](Ctx& c) { c.pictures.toggle_second_window(); }));
    out.push_back(command("view.fullscreen", "View", "Full screen", icons::kMonitor, "F11",
                          [](Ctx& c) { c.pictures.toggle_fullscreen(); }));
    out.push_back(command("view.layout", "View", "Reset layout", icons::kRestore, "", [](Ctx& c) {
        const UiState fresh;
        c.state.inspector_w = fresh.inspector_w;
        c.state.timeline_h = fresh.timeline_h;
        c.state.drawer_h = fresh.drawer_h;
        c.state.review_h = fresh.review_h;
        c.settings.sizes.clear();
    }));
}

void add_time_commands(std::vector<Command>& out) {
    const auto add = [&](const char* id, const char* name, const char* icon, const char* key,
                         auto run, bool repeats = false) {
        out.push_back(command(id, "Time", name, icon, key, run, has_plate));
        out.back().repeats = repeats;
    };
    add("time.play", "Play or pause", icons::kPlay, "Space",
        [](Ctx& c) { c.emit(Play{c.view.playing ? 0 : 1}); });
    add("time.reverse", "Play backwards", icons::kPlayReverse, "J",
        [](Ctx& c) { c.emit(Play{-1}); });
    add("time.stop", "Stop", icons::kStop, "K", [](Ctx& c) { c.emit(Play{0}); });
    add("time.forward", "Play forwards", icons::kPlay, "L", [](Ctx& c) { c.emit(Play{1}); });
    add(
        "time.previous", "Previous frame", icons::kStepBack, "Left",
        [](Ctx& c) { c.emit(StepFrames{-1}); }, true);
    add(
        "time.next", "Next frame", icons::kStepForward, "Right",
        [](Ctx& c) { c.emit(StepFrames{1}); }, true);
    add("time.previous_key", "Previous keyframe", icons::kChevronLeft, "Shift+Left",
        [](Ctx& c) { c.emit(StepKeyframe{-1}); });
    add("time.next_key", "Next keyframe", icons::kChevronRight, "Shift+Right",
        [](Ctx& c) { c.emit(StepKeyframe{1}); });
    out.push_back(command("time.suggested", "Time", "Next suggested frame", icons::kBrush,
                          "Ctrl+Right", ui::go_to_suggested, has_plate));
    add("time.keys", "Show keys and curves", icons::kKeyframe, "Ctrl+Shift+K",
        [](Ctx& c) { c.state.keys.open = !c.state.keys.open; });
    add("time.first", "First frame", icons::kSkipPrevious, "Home",
        [](Ctx& c) { c.emit(GoToFrame{c.view.plate.frames.front()}); });
    add("time.last", "Last frame", icons::kSkipNext, "End",
        [](Ctx& c) { c.emit(GoToFrame{c.view.plate.frames.back()}); });
    add("time.mode", "Loop, ping-pong or once", icons::kRefresh, "Ctrl+L", [](Ctx& c) {
        c.emit(SetPlayMode{static_cast<PlayMode>((static_cast<int>(c.view.play_mode) + 1) % 3)});
    });
    add("time.in", "Set in point", "", "I", [](Ctx& c) {
        c.emit(MarkRange{c.view.frame, c.view.mark_out});
    });
    add("time.out", "Set out point", "", "O", [](Ctx& c) {
        c.emit(MarkRange{c.view.mark_in, c.view.frame});
    });
    add("time.unmark", "Clear in and out points", "", "Shift+I",
        [](Ctx& c) { c.emit(MarkRange{}); });
}

void add_region_commands(std::vector<Command>& out) {
    out.push_back(command("region.add", "Region", "Add region", icons::kPlus, "Ctrl+Shift+N",
                          add_region, is_open));
    out.push_back(command(
        "region.duplicate", "Region", "Duplicate region", icons::kDuplicate, "Ctrl+D",
        [](Ctx& c) {
            Region copy = *c.view.selected_region();
            copy.id = 0;
            copy.name = free_region_name(c.view.project, copy.name + " copy");
            c.edit(AddRegion{copy, {}});
        },
        has_region));
    out.push_back(command(
        "region.remove", "Region", "Delete region", icons::kTrash, "",
        [](Ctx& c) {
            c.edit(RemoveRegion{{c.view.selected, {}}});
        },
        has_region));
    out.push_back(command(
        "region.solo", "Region", "Solo region", icons::kSolo, "Shift+S",
        [](Ctx& c) { c.emit(SoloRegion{c.view.solo == c.view.selected ? 0 : c.view.selected}); },
        has_region, [](const Ctx& c) { return c.view.solo != 0; }));
    out.push_back(command(
        "region.key", "Region", "Add matte keyframe", icons::kKeyframe, "Ctrl+K",
        [](Ctx& c) { c.emit(KeyMatteHere{}); }, has_region));
    out.push_back(command(
        "region.clear", "Region", "Clear matte on this frame", icons::kClose, "Delete",
        [](Ctx& c) { c.emit(ClearMatte{}); }, has_region));
    out.push_back(command("region.reference", "Region", "Add reference frame", icons::kReference,
                          "Ctrl+E", ui::add_reference_frame, has_region));
    out.push_back(command(
        "analysis.pause", "Region", "Pause analysis", icons::kPause, "",
        [](Ctx& c) { c.emit(PauseAnalysis{!c.view.analysis_paused}); }, is_open,
        [](const Ctx& c) { return c.view.analysis_paused; }));
}

void add_tool_commands(std::vector<Command>& out) {
    const auto add = [&](const char* id, const char* name, const char* icon, const char* key,
                         Tool tool) {
        out.push_back(command(
            id, "Tool", name, icon, key,
            [tool](Ctx& c) {
                c.state.tool = tool;
                c.state.brush.outline.clear();
                c.state.shape_drawing = false;
                c.state.form.from.reset();
                c.state.handle_held.clear();
            },
            {}, [tool](const Ctx& c) { return c.state.tool == tool; }));
    };
    add("tool.pan", "Pan", icons::kCursor, "A", Tool::kPan);
    add("tool.brush", "Brush", icons::kBrush, "B", Tool::kBrush);
    add("tool.eraser", "Eraser", icons::kEraser, "E", Tool::kEraser);
    add("tool.confirm", "Confirm edge: it is right here", icons::kCheckCircle, "Shift+E",
        Tool::kConfirm);
    add("tool.lasso", "Lasso", icons::kLasso, "Q", Tool::kLasso);
    add("tool.polygon", "Polygon", icons::kShape, "P", Tool::kPolygon);
    add("tool.shape", "Roto shape", icons::kCurve, "N", Tool::kShape);
    add("tool.scribble", "Scribble", icons::kPencil, "Shift+Q", Tool::kScribble);
    add("tool.similar", "Find similar textures", icons::kMagnify, "Shift+F", Tool::kSimilar);
    add("tool.pin", "Pin texture", icons::kPin, "Shift+P", Tool::kPin);
    add("tool.lamp", "Edit lamps", icons::kLightbulb, "Shift+L", Tool::kLamp);
    add("tool.keep", "Lock or regenerate patches", icons::kLock, "Shift+K", Tool::kKeep);
    add("tool.crypto", "Cryptomatte picker", icons::kPick, "Shift+C", Tool::kCrypto);
    add("tool.flood", "Select by colour", icons::kFlood, "U", Tool::kFlood);
    add("tool.place", "Transform texture", icons::kMove, "R", Tool::kPlace);
    add("tool.warp", "Grid warp", icons::kGridWarp, "Shift+N", Tool::kWarp);
    add("tool.form", "Draw form", icons::kForm, "Shift+D", Tool::kForm);
    add("tool.measure", "Scale by reference line", icons::kRuler, "Shift+M", Tool::kMeasure);
    out.push_back(command(
        "tool.snap", "Tool", "Snap to edges (Ctrl: other way)", icons::kMagnet, "Shift+Tab",
        [](Ctx& c) { c.state.snap = !c.state.snap; }, {},
        [](const Ctx& c) { return c.state.snap; }));
    const auto add_size = [&](const char* id, const char* name, const char* key, float factor) {
        out.push_back(command(id, "Tool", name, "", key, [factor](Ctx& c) {
            float& r = c.state.brush.brush.radius_px;
            r = std::clamp(r * factor, kLeastBrush_px, 2000.0f);
        }));
        out.back().repeats = true;
    };
    add_size("tool.smaller", "Smaller brush", "[", 1 / 1.2f);
    add_size("tool.larger", "Larger brush", "]", 1.2f);
    const auto add_hardness = [&](const char* id, const char* name, const char* key, float by) {
        out.push_back(command(id, "Tool", name, "", key, [by](Ctx& c) {
            float& h = c.state.brush.brush.hardness;
            h = std::clamp(h + by, 0.0f, 1.0f);
        }));
        out.back().repeats = true;
    };
    add_hardness("tool.softer", "Softer brush", "Shift+[", -0.1f);
    add_hardness("tool.harder", "Harder brush", "Shift+]", 0.1f);
}

void add_render_commands(std::vector<Command>& out) {
    out.push_back(command(
        "render.submit", "Render", "Render…", icons::kRocket, "Ctrl+Enter",
        [](Ctx& c) { set_workspace(c.state, Workspace::kJobs); }, is_open));
    out.push_back(command("help.shortcuts", "Help", "Keyboard shortcuts", icons::kKeyboard,
                          "Shift+/",
                          [](Ctx& c) { c.state.shortcuts_open = !c.state.shortcuts_open; }));
    out.push_back(
        command("help.tour", "Help", "The five-minute tour", icons::kSchool, "F1", [](Ctx& c) {
            c.state.tour_step = 0;
            if (!c.view.open) c.emit(OpenDemo{});
        }));
    out.push_back(command("help.about", "Help", "About Weft", icons::kInformation, "",
                          [](Ctx& c) { c.state.about_open = true; }));
}

}  // namespace

bool is_open(const Ctx& c) {
    return c.view.open;
}

std::vector<Command> all_commands() {
    std::vector<Command> out;
    add_file_commands(out);
    add_edit_commands(out);
    add_view_commands(out);
    add_time_commands(out);
    add_region_commands(out);
    add_tool_commands(out);
    add_render_commands(out);
    return out;
}

}  // namespace weft

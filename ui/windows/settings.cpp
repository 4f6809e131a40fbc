// Dialogs: keyboard shortcuts, settings, shot settings, and what Weft is.
#include <algorithm>
#include <cmath>

#include "engine/core/pixel_aspect.h"
#include "ui/base/icons.h"
#include "ui/parameters/parameters.h"
#include "ui/widgets/sheet.h"
#include "ui/widgets/widgets.h"
#include "ui/windows/windows.h"

namespace weft::ui {

void shortcut_sheet(Ctx& c) {
    if (!c.state.shortcuts_open) return;
    const Theme& t = c.theme;
    begin_sheet(c, "Keyboard shortcuts", {t.px(920), t.px(640)}, c.state.shortcuts_open);
    quiet(c, "Click a shortcut to change it; Esc cancels, Backspace clears it.");
    for (const std::string& clash : c.commands.collisions())
        banner(c, icons::kAlert, t.warn, "Duplicate shortcut: " + clash);
    ImGui::BeginChild("##keys", {0, 0});
    const float column = std::floor((ImGui::GetContentRegionAvail().x - t.px(40)) / 3);
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    float y[3] = {origin.y, origin.y, origin.y};
    std::string category;
    int at = -1;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto column_of = [](const std::string& name) {
        if (name == "View") return 1;
        return name == "Time" || name == "Tool" || name == "Render" ? 2 : 0;
    };
    for (const Command& command : c.commands.all()) {
        at = column_of(command.category);
        const float x = origin.x + (column + t.px(20)) * static_cast<float>(at);
        if (command.category != category) {
            category = command.category;
            if (y[at] > origin.y) y[at] += t.px(10);
            text_in(list, t.strong, {x, y[at]}, {x + column, y[at] + t.px(24)}, t.text,
                    category.c_str(), 0);
            y[at] += t.px(26);
        }
        ImGui::SetCursorScreenPos({x, y[at]});
        ImGui::PushID(command.id.c_str());
        if (ImGui::InvisibleButton("##key", {column, t.px(22)})) c.state.rebinding = command.id;
        ImGui::PopID();
        c.note(command.name);
        const bool listening = c.state.rebinding == command.id;
        if (ImGui::IsItemHovered() || listening)
            list.AddRectFilled({x - t.px(4), y[at]}, {x + column, y[at] + t.px(22)},
                               listening ? faded(t.accent, 0.3f) : t.hover, t.radius);
        ImGui::PushFont(t.small);
        text_in(list, t.small, {x, y[at]}, {x + column, y[at] + t.px(22)}, t.quiet,
                fitted(command.name, column - t.px(90)).c_str(), 0);
        ImGui::PopFont();
        text_in(list, t.small, {x, y[at]}, {x + column - t.px(6), y[at] + t.px(22)}, t.text,
                listening ? "press a key" : chord_text(command.key).c_str(), 1);
        y[at] += t.px(22);
    }
    ImGui::SetCursorScreenPos({origin.x, std::max({y[0], y[1], y[2]})});
    ImGui::Dummy({1, t.px(8)});
    ImGui::EndChild();
    end_sheet(c);
    if (c.state.rebinding.empty()) return;
    const KeyChord pressed = pressed_chord(false);
    if (pressed.key == 0) return;
    if (pressed.key == 259)
        c.settings.keys[c.state.rebinding] = "";
    else if (pressed.key != 256)
        c.settings.keys[c.state.rebinding] = chord_text(pressed);
    c.commands.bind(c.settings.keys);
    c.state.rebinding.clear();
}

void settings_window(Ctx& c) {
    if (!c.state.settings_open) return;
    const Theme& t = c.theme;
    begin_sheet(c, "Settings", {t.px(460), t.px(380)}, c.state.settings_open);
    quiet(c, "Theme");
    int dark = c.settings.dark ? 0 : 1;
    if (segments(c, "Theme", {"Dark", "Light"}, dark)) c.settings.dark = dark == 0;
    ImGui::Dummy({0, t.px(6)});
    quiet(c, "Viewer background");
    int grey = c.settings.grey_surround ? 1 : 0;
    if (segments(c, "Surround", {"Same as theme", "18% grey"}, grey))
        c.settings.grey_surround = grey == 1;
    ImGui::Dummy({0, t.px(6)});
    quiet(c, "UI scale");
    const double scales[] = {0, 1, 1.25, 1.5, 2};
    int scale = 0;
    for (int k = 1; k < 5; ++k)
        if (std::abs(c.settings.ui_scale - scales[k]) < 0.01) scale = k;
    if (segments(c, "Scale", {"Auto", "100%", "125%", "150%", "200%"}, scale))
        c.settings.ui_scale = scales[scale];
    ImGui::Dummy({0, t.px(6)});
    quiet(c, "Paint program, by its command");
    input(c, "Paint program", c.settings.paint_program,
          c.view.paint_programs.empty() ? "krita, or /opt/…/program"
                                        : c.view.paint_programs.front().command.c_str(),
          t.px(300));
    ImGui::Dummy({0, t.px(10)});
    if (button(c, "Keyboard shortcuts…", {.icon = icons::kKeyboard})) {
        c.state.settings_open = false;
        c.state.shortcuts_open = true;
    }
    ImGui::SameLine();
    if (button(c, "Reset shortcuts")) {
        c.settings.keys.clear();
        c.commands.bind(c.settings.keys);
    }
    end_sheet(c);
}

// The shape of the plate's pixels: as its files say, or another one. The plate is opened anew when
// it changes, so only the view follows a drag.
void aspect_parameter(Ctx& c) {
    const auto set = [&](ParameterValue value) {
        c.emit(DoEdit{SetProjectParameter{"plate.pixel_aspect", std::move(value)}});
    };
    const std::optional<double>& given = c.view.project.plate.pixel_aspect;
    bool automatic = !given;
    if (checkbox(c, "Automatic pixel aspect", automatic,
                 "Pixel width divided by height as the plate's files say"))
        set(automatic ? ParameterValue{} : ParameterValue{c.view.plate.pixel_aspect});
    if (!given) return;
    std::optional<double>& dragged = c.state.viewer.aspect_dragged;
    double aspect = dragged.value_or(*given);
    const Change change =
        slider(c,
               {.label = "Pixel aspect",
                .tip = "Pixel width divided by height: 2 for anamorphic. Textures, "
                       "shapes and the brush act on the picture unsqueezed",
                .min = 0.5,
                .max = 2,
                .standard = 1,
                .typed_min = PixelAspect::kLeast,
                .typed_max = PixelAspect::kMost},
               aspect);
    if (change == Change::kTrying) dragged = aspect;
    if (change != Change::kDone) return;
    dragged.reset();
    set(aspect);
}

// The plate and the shot's colour settings.
void shot_window(Ctx& c) {
    if (!c.state.shot_open) return;
    const Theme& t = c.theme;
    begin_sheet(c, "Shot settings", {t.px(540), t.px(600)}, c.state.shot_open);
    heading(c, "Plate");
    project_parameter(c, "plate.path", "Frames");
    project_parameter(c, "plate.layer", "Layer");
    space_parameter(c, "plate.space", "Colour space", "Auto (from file type)");
    project_parameter(c, "plate.fps", "Frame rate");
    aspect_parameter(c);
    ImGui::Dummy({0, t.px(8)});
    heading(c, "Colour");
    space_parameter(c, "color.working_space", "Working space", "Linear");
    space_parameter(c, "color.texture_space", "Textures", "Auto (from file type)");
    space_parameter(c, "color.out_space", "Result", "Auto (from file type)");
    ImGui::Dummy({0, t.px(8)});
    heading(c, "Render");
    project_parameter(c, "settings.seed", "Seed");
    project_parameter(c, "settings.excluded_licences", "Exclude licences");
    project_parameter(c, "output.exr_compression", "EXR compression");
    project_parameter(c, "output.jpeg_quality");
    end_sheet(c);
}

void about_window(Ctx& c) {
    if (!c.state.about_open) return;
    const Theme& t = c.theme;
    begin_sheet(c, "About Weft", {t.px(420), t.px(230)}, c.state.about_open);
    wrapped(c,
            "Weft replaces textures in animation: mask a surface, choose a texture, and it "
            "stays on that surface through the whole shot, lit like the plate.",
            t.text);
    ImGui::Dummy({0, t.px(6)});
    wrapped(c, "Set in Inter, with Material Design Icons. The interface is drawn with Dear ImGui.",
            t.quiet);
    end_sheet(c);
}

}  // namespace weft::ui

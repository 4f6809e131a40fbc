// The viewer's controls: quality, zoom, exposure, gamma, channels and comparisons.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "ui/viewer/compare.h"
#include "ui/viewer/overlays.h"
#include "ui/viewer/parts.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

// Widths in px. The bar's is without the choice of the screen, which is as wide as its text.
constexpr int kQualityWidth = 88, kCompareWidth = 84, kBarWidth = 524 + kQualityWidth + 6;
// What the state of the picture needs beside the bar before a comparison is offered there, too.
constexpr int kStateWidth = 220;  // px

float screen_width(const Ctx& c) {
    const Theme& t = c.theme;
    ImGui::PushFont(t.small);
    const float text = ImGui::CalcTextSize(c.view.screen_name.view.c_str()).x;
    ImGui::PopFont();
    return std::clamp(std::ceil(text) + t.px(14), t.px(44), t.px(104));
}

float bar_width(const Ctx& c) {
    return c.theme.px(kBarWidth) + screen_width(c);
}

bool has_compare(const Ctx& c, float width) {
    return width >= bar_width(c) + c.theme.px(kCompareWidth + kStateWidth);
}

// The view transform: a built-in curve, or a view of the OpenColorIO config.
void screen_choice(Ctx& c) {
    const Theme& t = c.theme;
    const ScreenName& now = c.view.screen_name;
    const float width = screen_width(c);
    ImGui::InvisibleButton("##Screen", {width, t.px(26)});
    c.note("Screen");
    ImGui::PushFont(t.small);
    const std::string text = fitted(now.view, width - t.px(12));
    ImGui::PopFont();
    text_in(*ImGui::GetWindowDrawList(), t.small, ImGui::GetItemRectMin(), ImGui::GetItemRectMax(),
            t.text, text.c_str());
    const std::string tip =
        now.display.empty()
            ? "View transform" +
                  std::string(c.view.screens.empty()
                                  ? ". Set $OCIO to an OpenColorIO config for its views"
                                  : "")
            : "View: " + now.view + " of " + now.display;
    tooltip(c, tip.c_str());
    if (ImGui::IsItemClicked()) ImGui::OpenPopup("##screens");
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {t.px(6), t.px(6)});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {t.px(8), t.px(6)});
    if (ImGui::BeginPopup("##screens")) {
        const auto item = [&](const ScreenName& name, const char* shown) {
            if (ImGui::MenuItem(shown, nullptr, name == now)) c.emit(ChooseScreen{name});
            c.note("Screen " + (name.display.empty() ? "" : name.display + " ") + name.view);
        };
        item({"", kScreenSrgb}, "sRGB");
        item({"", kScreenVideo}, "Video (BT.1886)");
        item({"", kScreenRaw}, "Raw (linear)");
        std::vector<std::string> displays;
        for (const ScreenName& name : c.view.screens)
            if (std::find(displays.begin(), displays.end(), name.display) == displays.end())
                displays.push_back(name.display);
        for (const std::string& display : displays) {
            ImGui::Separator();
            quiet(c, display.c_str());
            ImGui::PushID(display.c_str());
            for (const ScreenName& name : c.view.screens)
                if (name.display == display) item(name, name.view.c_str());
            ImGui::PopID();
        }
        ImGui::EndPopup();
    }
    ImGui::PopStyleVar(2);
}

// A value that is dragged or clicked.
void view_value(Ctx& c, const char* id, const std::string& text, float width, const char* tip,
                const char* command) {
    const Theme& t = c.theme;
    ImGui::InvisibleButton(id, {width, t.px(26)});
    c.note(id + 2);
    text_in(*ImGui::GetWindowDrawList(), t.small, ImGui::GetItemRectMin(), ImGui::GetItemRectMax(),
            t.text, text.c_str());
    tooltip(c, tip, command);
}

// Zoom, exposure, gamma and channel.
void display_values(Ctx& c) {
    const Theme& t = c.theme;
    ViewerState& s = c.state.viewer;
    view_value(c, "##Zoom", number_text(100.0 * static_cast<double>(s.zoom), 0) + "%", t.px(48),
               "Zoom. Wheel to zoom, click to fit", "view.fit");
    if (ImGui::IsItemClicked()) s.fit = true;
    ImGui::SameLine();
    view_value(c, "##Exposure", "exp " + number_text(static_cast<double>(s.display.exposure), 2),
               t.px(66), "Exposure of the view in stops. Drag, or use , and .", nullptr);
    if (ImGui::IsItemActive()) s.display.exposure += ImGui::GetIO().MouseDelta.x * 0.01f / t.scale;
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) s.display.exposure = 0;
    ImGui::SameLine();
    view_value(c, "##Gamma", "γ " + number_text(static_cast<double>(s.display.gamma), 2), t.px(54),
               "Gamma of the view. Drag to change", nullptr);
    if (ImGui::IsItemActive())
        s.display.gamma = std::clamp(
            s.display.gamma + ImGui::GetIO().MouseDelta.x * 0.005f / t.scale, 0.2f, 4.0f);
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) s.display.gamma = 1;
    ImGui::SameLine();
    constexpr const char* kChannels[] = {"RGB", "R", "G", "B", "Y"};
    view_value(c, "##Channel", kChannels[static_cast<int>(s.display.channel)], t.px(40),
               "Channel. Click for the next one", "view.color");
    if (ImGui::IsItemClicked())
        s.display.channel =
            static_cast<DisplaySettings::Channel>((static_cast<int>(s.display.channel) + 1) % 5);
}

void shown_layer_choice(Ctx& c) {
    const Theme& t = c.theme;
    const std::string layer(c.view.layer ? info_of(*c.view.layer).name : "result");
    view_value(c, "##Layer", layer, t.px(62), "Layer shown in the viewer", nullptr);
    if (ImGui::IsItemClicked()) ImGui::OpenPopup("##layers");
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {t.px(6), t.px(6)});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {t.px(8), t.px(6)});
    if (ImGui::BeginPopup("##layers")) {
        const auto item = [&](std::string_view label, std::optional<LayerKind> kind) {
            if (ImGui::MenuItem(label.data(), nullptr, c.view.layer == kind)) {
                c.state.viewer.compare = Compare::kResult;
                c.emit(ShowLayer{kind});
            }
            c.note("Layer " + std::string(label));
        };
        item("result", std::nullopt);
        for (const LayerInfo& known : kLayers)
            item(known.name, known.kind);
        ImGui::EndPopup();
    }
    ImGui::PopStyleVar(2);
}

// Draft or final, of what is seen.
void quality_choice(Ctx& c) {
    int quality = c.view.preview_quality == Quality::kDraft ? 0 : 1;
    if (segments(c, "Quality", {"Draft", "Final"}, quality, c.theme.px(kQualityWidth - 6)))
        c.emit(SetPreviewQuality{quality == 0 ? Quality::kDraft : Quality::kFinal});
}

}  // namespace

float view_controls_width(const Ctx& c, float width) {
    const Theme& t = c.theme;
    const float bar = bar_width(c);
    if (width < bar + t.px(20)) return t.px(kQualityWidth);
    return bar + (has_compare(c, width) ? t.px(kCompareWidth) : 0);
}

void view_controls(Ctx& c, ImVec2 min, ImVec2 max) {
    const Theme& t = c.theme;
    const float bar_w = view_controls_width(c, max.x - min.x);
    const bool all = bar_w > t.px(kQualityWidth);
    const ImVec2 at(std::floor(max.x - bar_w - t.px(4)), min.y);
    ImGui::SetCursorScreenPos({at.x + t.px(4), at.y + t.px(2)});
    const PanelName name(c, "View");
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {t.px(2), 0});
    quality_choice(c);
    if (!all) {
        ImGui::PopStyleVar();
        return;
    }
    ImGui::SameLine(0, t.px(6));
    display_values(c);
    ImGui::SameLine();
    shown_layer_choice(c);
    ImGui::SameLine();
    screen_choice(c);
    ImGui::SameLine(0, t.px(10));
    const auto tool = [&](const char* id) {
        const Command* command = c.commands.find(id);
        const bool enabled = !command->enabled || command->enabled(c);
        if (icon_button(c, command->icon, command->name.c_str(), command->checked(c), id, enabled,
                        t.px(26)))
            command->run(c);
        ImGui::SameLine();
    };
    if (has_compare(c, max.x - min.x)) {
        compare_choice(c, t.px(kCompareWidth - 4));
        ImGui::SameLine(0, t.px(4));
    }
    for (const char* id : {"view.plate", "view.wipe", "view.difference", "view.side", "view.four"})
        tool(id);
    ImGui::SameLine(0, t.px(10));
    for (const char* id : {"view.mattes", "view.grid", "view.seams"})
        tool(id);
    ImGui::PopStyleVar();
}

}  // namespace weft::ui

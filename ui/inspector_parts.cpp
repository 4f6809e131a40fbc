// Parts of the inspector: shapes, corrections, lamps, and where a result comes from.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/session/lamp_edit.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace weft::ui {

void shape_controls(Ctx& c) {
    const Theme& t = c.theme;
    if (c.state.shape_drawing) {
        wrapped(c, "Click for corners, drag for curves. Enter closes the shape, Esc drops it.",
                t.quiet);
        return;
    }
    if (!c.view.shape) {
        wrapped(c, "Click on the picture to begin a shape; drag for a curve.", t.quiet);
        return;
    }
    wrapped(c,
            "Drag points. Shift moves the whole shape, Ctrl sets a point's feather, Alt removes a "
            "point; Alt beside the shape begins another.",
            t.quiet);
    std::string frames;
    for (const int frame : c.view.shape_frames)
        frames += (frames.empty() ? "" : ", ") + std::to_string(frame);
    info_row(c, "Drawn on", frames, "Frames on which the shape was set by hand");
    if (button(c, "Smooth the corners",
               {.enabled = !c.view.matte_busy,
                .tip = "Gives every corner handles along its neighbours",
                .width = -1}))
        c.emit(SetShape{smoothed(*c.view.shape)});
    if (button(c, "Fill between the shapes",
               {.icon = icons::kKeyframe,
                .enabled = c.view.shape_frames.size() > 1,
                .tip = "Gives every frame between two shapes a matte from the shape in between. "
                       "Otherwise they follow the motion of the surface",
                .width = -1}))
        c.emit(FillBetweenShapes{});
}

void corrections_section(Ctx& c, const Region& region) {
    const Theme& t = c.theme;
    if (!section(c, "Corrections")) return;
    const PanelName panel(c, "Corrections");
    if (button(c, "Pin the texture",
               {.icon = icons::kPin,
                .look = c.state.tool == Tool::kPin ? Look::kPrimary : Look::kNormal,
                .tip = "Click to hold a place, drag to put the texture back where it belongs, Alt "
                       "removes a pin",
                .command = "tool.pin",
                .width = -1}))
        c.state.tool = Tool::kPin;
    if (region.corrections.empty())
        wrapped(c,
                "Where the texture has slid, pin it back on that frame; the frames between two "
                "corrections follow.",
                t.quiet);
    for (const auto& [frame, pins] : region.corrections) {
        ImGui::PushID(frame);
        const std::string label = "Frame " + std::to_string(frame) + ", " +
                                  std::to_string(pins.size()) +
                                  (pins.size() == 1 ? " pin" : " pins");
        if (button(c, label.c_str(),
                   {.icon = icons::kPin,
                    .look = frame == c.view.frame ? Look::kNormal : Look::kQuiet}))
            c.emit(GoToFrame{frame});
        ImGui::SameLine();
        if (icon_button(c, icons::kClose, ("Unpin " + std::to_string(frame)).c_str(), false,
                        nullptr, true, t.row))
            c.edit(SetCorrection{{region.id, {}}, frame, {}});
        ImGui::PopID();
    }
    section_gap(c);
}

namespace {

void add_lamp_buttons(Ctx& c, const Region& region) {
    const Size plate = c.view.plate.size;
    const auto w = static_cast<float>(plate.width), h = static_cast<float>(plate.height);
    const float third = std::floor((ImGui::GetContentRegionAvail().x - 2 * c.theme.gap) / 3);
    const auto add = [&](const char* label, const char* tip, LampHandle lamp) {
        if (!button(c, label, {.enabled = !plate.empty(), .tip = tip, .width = third})) return;
        c.edit(SetRegionParameter{
            {region.id, {}}, "light.lamps", with_new_lamp(region.light.lamps, lamp)});
        c.state.lamp = static_cast<int>(lamps_at(region.light.lamps, c.view.frame).size());
        c.state.tool = Tool::kLamp;
    };
    using Kind = LampHandle::Kind;
    add("+ Lamp", "A bright or dark spot",
        {Kind::kPoint, {w / 2, h / 2, 0.25f * std::min(w, h), 1.5f}, false});
    ImGui::SameLine();
    add("+ Side", "Light from one side of the picture", {Kind::kDirectional, {135, 1.3f}, false});
    ImGui::SameLine();
    add("+ Fall", "From one brightness to another between two points",
        {Kind::kGradient, {w / 2, 0.1f * h, w / 2, 0.9f * h, 1.2f, 0.8f}, false});
}

}  // namespace

void lamps_controls(Ctx& c, const Region& region) {
    add_lamp_buttons(c, region);
    const std::vector<LampHandle> lamps = lamps_at(region.light.lamps, c.view.frame);
    if (lamps.empty()) {
        wrapped(c, "Add a lamp, then drag it on the picture (Shift+L).", c.theme.quiet);
        return;
    }
    c.state.lamp = std::clamp(c.state.lamp, 0, static_cast<int>(lamps.size()) - 1);
    std::vector<std::string> names;
    for (std::size_t k = 0; k < lamps.size(); ++k) {
        static constexpr const char* kNames[] = {"Lamp ", "Side ", "Fall "};
        names.push_back(kNames[static_cast<int>(lamps[k].kind)] + std::to_string(k + 1));
    }
    int chosen = c.state.lamp;
    if (choice(c, "Selected", names, chosen)) c.state.lamp = chosen;
    const auto index = static_cast<std::size_t>(c.state.lamp);
    const LampHandle& lamp = lamps[index];
    const RegionRef ref{region.id, {}};
    const auto gain = [&](const char* label, std::size_t which) {
        double value = static_cast<double>(lamp.numbers[which]);
        const Change change = slider(c,
                                     {.label = label,
                                      .unit = "×",
                                      .tip = "1 leaves the surface as it is",
                                      .min = 0.1,
                                      .max = 4,
                                      .standard = 1,
                                      .logarithmic = true,
                                      .typed_min = 0.01,
                                      .typed_max = 100},
                                     value);
        if (change == Change::kNone) return;
        std::vector<float> numbers = lamp.numbers;
        numbers[which] = static_cast<float>(value);
        const SetRegionParameter set{ref, "light.lamps",
                                     with_lamp(region.light.lamps, index, c.view.frame, numbers)};
        if (change == Change::kDone)
            c.edit(set);
        else
            c.emit(TryEdit{set});
    };
    if (lamp.kind == LampHandle::Kind::kGradient) {
        gain("Start", 4);
        gain("End", 5);
    } else {
        gain("Brightness", lamp.numbers.size() - 1);
    }
    const float half = std::floor((ImGui::GetContentRegionAvail().x - c.theme.gap) / 2);
    if (button(c, "Key here##lamp",
               {.icon = icons::kKeyframe,
                .tip = "From now on this lamp changes over time; a change becomes a key of the "
                       "frame it is made on",
                .width = half}))
        c.edit(SetRegionParameter{
            ref, "light.lamps",
            with_lamp(region.light.lamps, index, c.view.frame, lamp.numbers, true)});
    ImGui::SameLine();
    if (button(c, "Remove##lamp", {.icon = icons::kTrash, .width = half}))
        c.edit(SetRegionParameter{ref, "light.lamps", without_lamp(region.light.lamps, index)});
}

// Where what one sees comes from, for licences and for making it again.
void provenance_section(Ctx& c, const Region& region) {
    if (!section(c, "Made from", false)) return;
    const PanelName panel(c, "Provenance");
    const bool plane = !region.texture.plane.empty();
    const std::string& path = plane ? region.texture.plane : region.texture.sample;
    if (path.empty()) {
        wrapped(c, "No texture is chosen yet.", c.theme.quiet);
        section_gap(c);
        return;
    }
    info_row(c, plane ? "Picture" : "Sample", std::filesystem::path(path).filename().string(),
             path.c_str());
    // What came from the library is named by its id.
    TextureCard card;
    card.path = library_name_of(path);
    if (!card.path.empty()) {
        const TextureCard known = c.textures.details(card);
        info_row(c, "Material", known.material.empty() ? "…" : known.material);
        info_row(c, "Author", known.author.empty() ? "not stated" : known.author);
        info_row(c, "Licence", known.licence.empty() ? "not stated" : known.licence);
        info_row(c, "Source", known.source.empty() ? "not stated" : known.source);
    } else {
        info_row(c, "Licence", "your own file", "Nothing is known about it but its name");
    }
    if (!plane) {
        info_row(c, "Seed", std::to_string(c.view.project.settings.seed));
        info_row(c, "Overlap", std::to_string(region.synthesis.overlap_px) + " px");
    }
    info_row(c, "Backend", c.view.backend);
    if (button(c, "Copy as text", {.icon = icons::kCopy, .width = -1}))
        c.pictures.set_clipboard(region.name + ": " + path + ", seed " +
                                 std::to_string(c.view.project.settings.seed) + ", frame " +
                                 std::to_string(c.view.frame) + " of " + c.view.plate.path);
    section_gap(c);
}

void time_section(Ctx& c, const Region& region) {
    if (!section(c, "Through time")) return;
    const PanelName panel(c, "Time");
    region_parameter(c, region, "temporal.mode", "The texture is");
    if (region.temporal.mode == TemporalMode::kPaper) {
        region_parameter(c, region, "temporal.blend");
        region_parameter(c, region, "temporal.weight");
    }
    section_gap(c);
}

}  // namespace weft::ui

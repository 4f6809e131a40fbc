// The part of the light inspector for lamps.
#include <algorithm>
#include <cmath>
#include <vector>

#include "ui/base/icons.h"
#include "ui/light/sections.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

void add_lamp_buttons(Ctx& c, const Region& region) {
    const Size plate = c.view.plate.size;
    const double w = plate.width, h = plate.height;
    const float third = std::floor((ImGui::GetContentRegionAvail().x - 2 * c.theme.gap) / 3);
    const auto add = [&](const char* label, const char* tip, LampKind kind,
                         std::vector<double> numbers) {
        if (!button(c, label, {.enabled = !plate.empty(), .tip = tip, .width = third})) return;
        std::vector<Lamp> lamps = region.light.lamps;
        lamps.push_back({kind, {{{0, std::move(numbers)}}}});
        c.state.lamp = static_cast<int>(lamps.size()) - 1;
        c.edit(SetRegionParameter{{region.id, {}}, "light.lamps", std::move(lamps)});
        c.state.tool = Tool::kLamp;
    };
    add("+ Point", "Point light: a bright or dark spot", LampKind::kPoint,
        {w / 2, h / 2, 0.25 * std::min(w, h), 1.5});
    ImGui::SameLine();
    add("+ Directional", "Directional light: from one side of the picture", LampKind::kDirectional,
        {135, 1.3});
    ImGui::SameLine();
    add("+ Gradient", "Gradient light: between two points", LampKind::kGradient,
        {w / 2, 0.1 * h, w / 2, 0.9 * h, 1.2, 0.8});
}

}  // namespace

void lamps_controls(Ctx& c, const Region& region) {
    add_lamp_buttons(c, region);
    const std::vector<Lamp>& lamps = region.light.lamps;
    if (lamps.empty()) {
        wrapped(c, "Add a lamp, then drag it on the picture (Shift+L).", c.theme.quiet);
        return;
    }
    c.state.lamp = std::clamp(c.state.lamp, 0, static_cast<int>(lamps.size()) - 1);
    std::vector<std::string> names;
    for (std::size_t k = 0; k < lamps.size(); ++k) {
        static constexpr const char* kNames[] = {"Point ", "Directional ", "Gradient "};
        names.push_back(kNames[static_cast<int>(lamps[k].kind)] + std::to_string(k + 1));
    }
    int chosen = c.state.lamp;
    if (choice(c, "Selected", names, chosen)) c.state.lamp = chosen;
    const auto index = static_cast<std::size_t>(c.state.lamp);
    const Lamp& lamp = lamps[index];
    const std::vector<double> here = lamp.numbers.at(c.view.frame);
    const RegionRef ref{region.id, {}};
    const auto gain = [&](const char* label, std::size_t which) {
        double value = here[which];
        const Change change = slider(c,
                                     {.label = label,
                                      .unit = "×",
                                      .tip = "1 changes nothing",
                                      .min = 0.1,
                                      .max = 4,
                                      .standard = 1,
                                      .logarithmic = true,
                                      .typed_min = 0.01,
                                      .typed_max = 100},
                                     value);
        if (change == Change::kNone) return;
        std::vector<double> numbers = here;
        numbers[which] = value;
        std::vector<Lamp> changed = lamps;
        set_numbers(changed[index], c.view.frame, std::move(numbers));
        const SetRegionParameter set{ref, "light.lamps", std::move(changed)};
        if (change == Change::kDone)
            c.edit(set);
        else
            c.emit(TryEdit{set});
    };
    if (lamp.kind == LampKind::kGradient) {
        gain("Start", 4);
        gain("End", 5);
    } else {
        gain("Brightness", here.size() - 1);
    }
    const float half = std::floor((ImGui::GetContentRegionAvail().x - c.theme.gap) / 2);
    if (button(c, "Add keyframe##lamp",
               {.icon = icons::kKeyframe,
                .tip = "Animates this lamp; later changes set a keyframe on the "
                       "current frame",
                .width = half})) {
        std::vector<Lamp> changed = lamps;
        changed[index].numbers.set(c.view.frame, here);
        c.edit(SetRegionParameter{ref, "light.lamps", std::move(changed)});
    }
    ImGui::SameLine();
    if (button(c, "Remove##lamp", {.icon = icons::kTrash, .width = half})) {
        std::vector<Lamp> changed = lamps;
        changed.erase(changed.begin() + c.state.lamp);
        c.edit(SetRegionParameter{ref, "light.lamps", std::move(changed)});
    }
}

}  // namespace weft::ui

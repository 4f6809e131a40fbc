// Controls of parameters that may have keyframes: of a region, and of the matte that is edited.
#include <cmath>

#include "app/mattes/matte_layer.h"
#include "ui/parameters/parameter_control.h"
#include "ui/parameters/parameters.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

// A keyframe button: hollow without animation, filled on a keyframe.
bool key_button(Ctx& c, const char* name, bool here, bool anywhere) {
    const Theme& t = c.theme;
    const float side = t.px(24);
    ImGui::PushID(name);
    const bool pressed = ImGui::InvisibleButton("##key", {side, side});
    ImGui::PopID();
    c.note(name);
    const ImVec2 min = ImGui::GetItemRectMin();
    const ImVec2 mid(min.x + side / 2, min.y + side / 2);
    const float r = t.px(5);
    const ImU32 color = ImGui::IsItemHovered() ? t.text : anywhere ? t.accent_hover : t.off;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (here)
        list.AddQuadFilled({mid.x, mid.y - r}, {mid.x + r, mid.y}, {mid.x, mid.y + r},
                           {mid.x - r, mid.y}, color);
    else
        list.AddQuad({mid.x, mid.y - r}, {mid.x + r, mid.y}, {mid.x, mid.y + r}, {mid.x - r, mid.y},
                     color, t.px(1.3f));
    tooltip(c, here ? "Remove the keyframe on this frame" : "Add a keyframe on this frame");
    return pressed;
}

std::vector<double> numbers(const ParameterValue& value) {
    if (const auto* list = std::get_if<std::vector<double>>(&value)) return *list;
    const auto* one = std::get_if<double>(&value);
    return {one ? *one : 0.0};
}

// A control with its keyframe button. `set(key, value, done)` changes one of the two entries.
template <class Owner, class Set>
void keyed_control(Ctx& c, const Owner& owner, const Parameter<Owner>& info,
                   const Parameter<Owner>& keys_info, const char* label, Set&& set) {
    const Theme& t = c.theme;
    auto keys = std::get<KeyedNumbers>(keys_info.read(owner));
    ParameterValue now = info.read(owner);
    if (!keys.empty()) {
        const std::vector<double> here = keys.at(c.view.frame);
        now = here.size() == 1 ? ParameterValue(here[0]) : ParameterValue(here);
    }
    // Drawn before the row, because the first item drawn receives the mouse.
    const bool here = keys.has(c.view.frame);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float label_w = std::floor(ImGui::GetContentRegionAvail().x * 0.38f);
    ImGui::SetCursorScreenPos({at.x + label_w - t.px(26), at.y + t.px(1)});
    const std::string name = parameter_name(info, label);
    if (key_button(c, ((here ? "Unkey " : "Key ") + name).c_str(), here, !keys.empty())) {
        if (here)
            keys.erase(c.view.frame);
        else
            keys.set(c.view.frame, numbers(now));
        set(keys_info, ParameterValue(keys), true);
    }
    ImGui::SetCursorScreenPos(at);
    parameter_control(c, info, now, label, [&](const ParameterValue& value, bool done) {
        if (keys.empty()) return set(info, value, done);
        keys.set(c.view.frame, numbers(value));
        set(keys_info, ParameterValue(keys), done);
    });
}

// Changes an entry of the matte that is edited.
void set_of_layer(Ctx& c, const Region& region, const Parameter<MatteSource>& entry,
                  const ParameterValue& value, bool done) {
    MatteSource matte = layer_source(region, c.view.matte_layer);
    if (!set_parameter(matte, entry, value)) return;
    const RegionRef ref{region.id, {}};
    const Edit edit = c.view.matte_layer == 0
                          ? Edit(SetRegionParameter{ref, entry.full_key(), value})
                          : set_layer(region, c.view.matte_layer, std::move(matte));
    if (done)
        c.emit(DoEdit{edit});
    else
        c.emit(TryEdit{edit});
}

}  // namespace

void keyed_parameter(Ctx& c, const Region& region, std::string_view key, std::string_view keys_key,
                     const char* label) {
    const auto value = find_parameter(region_parameters(), key);
    const auto keys = find_parameter(region_parameters(), keys_key);
    if (!value || !keys) return;
    keyed_control(c, region, **value, **keys, label,
                  [&](const ParameterInfo& entry, const ParameterValue& to, bool done) {
                      const SetRegionParameter edit{{region.id, {}}, entry.full_key(), to};
                      if (done)
                          c.emit(DoEdit{edit});
                      else
                          c.emit(TryEdit{edit});
                  });
}

void matte_parameter(Ctx& c, const Region& region, std::string_view key,
                     std::string_view keys_key) {
    const auto value = find_parameter(matte_parameters(), key);
    if (!value) return;
    const MatteSource& matte = layer_source(region, c.view.matte_layer);
    const auto set = [&](const Parameter<MatteSource>& entry, const ParameterValue& to, bool done) {
        set_of_layer(c, region, entry, to, done);
    };
    if (keys_key.empty())
        return parameter_control(
            c, **value, (*value)->read(matte), nullptr,
            [&](const ParameterValue& to, bool done) { set(**value, to, done); });
    const auto keys = find_parameter(matte_parameters(), keys_key);
    if (keys) keyed_control(c, matte, **value, **keys, nullptr, set);
}

}  // namespace weft::ui

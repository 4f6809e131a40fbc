// Lamps, dragged on the picture.
#include <algorithm>
#include <cmath>
#include <vector>

#include "ui/canvas/angles.h"
#include "ui/canvas/handles.h"
#include "ui/light/light.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

// The text beside a handle, legible on any picture.
void tag(Ctx& c, ImVec2 at, const char* text) {
    const Theme& t = c.theme;
    const float w = t.small->CalcTextSizeA(t.small->FontSize, FLT_MAX, 0, text).x;
    const ImVec2 min(at.x + t.px(10), at.y - t.px(9)), max(min.x + w + t.px(8), at.y + t.px(9));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(min, max, t.scrim, t.radius);
    text_in(list, t.small, min, max, t.text, text);
}

void set_lamp(Ctx& c, const Region& region, std::size_t index, const std::vector<float>& numbers,
              bool final) {
    std::vector<Lamp> lamps = region.light.lamps;
    set_numbers(lamps[index], c.view.frame, {numbers.begin(), numbers.end()});
    const SetRegionParameter set{{region.id, {}}, "light.lamps", std::move(lamps)};
    if (final)
        c.edit(set);
    else
        c.emit(TryEdit{set});
}

// A handle for two numbers of a lamp that are a point on the plate.
bool place_handle(Ctx& c, const ViewMap& map, const std::string& id, std::vector<float>& n,
                  std::size_t x, bool hovered, ImU32 color, Grip& grip) {
    Vec2 at{n[x], n[x + 1]};
    const Grip now = handle(c, map, id, at, hovered, color);
    if (now == Grip::kHeld || now == Grip::kLetGo) {
        n[x] = at.x;
        n[x + 1] = at.y;
        grip = now;
        return true;
    }
    return now == Grip::kTaken;
}

}  // namespace

void lamp_tool(Ctx& c, const ViewMap& map, bool hovered) {
    const Region* region = c.view.selected_region();
    if (!region || region->light.source != LightSource::kPainted) return;
    const std::vector<Lamp>& lamps = region->light.lamps;
    const Size plate = c.view.plate.size;
    const Vec2 middle{static_cast<float>(plate.width) / 2, static_cast<float>(plate.height) / 2};
    const PixelAspect aspect = plate_aspect(c);
    for (std::size_t k = 0; k < lamps.size(); ++k) {
        std::vector<float> n = lamps[k].numbers.float_at(c.view.frame);
        const std::string id = "lamp " + std::to_string(k + 1);
        const ImU32 color = c.state.lamp == static_cast<int>(k) ? c.theme.warn : c.theme.text;
        Grip grip = Grip::kNone;
        bool taken = false;
        if (lamps[k].kind == LampKind::kPoint) {
            const Vec2 at{n[0], n[1]};
            plate_circle(c, map, at, n[2], faded(color, 0.7f), c.theme.px(1.5f));
            Vec2 rim = at + aspect.squeezed(Vec2(n[2], 0));
            const Grip on_rim = handle(c, map, id + " radius", rim, hovered, color, false);
            if (on_rim == Grip::kHeld || on_rim == Grip::kLetGo) {
                const Vec2 way = aspect.unsqueezed(rim - at);
                n[2] = std::max(4.0f, std::hypot(way.x, way.y));
                grip = on_rim;
            }
            taken = on_rim == Grip::kTaken;
            taken |= place_handle(c, map, id, n, 0, hovered, color, grip);
        } else if (lamps[k].kind == LampKind::kGradient) {
            plate_line(c, map, {n[0], n[1]}, {n[2], n[3]}, faded(color, 0.7f));
            taken = place_handle(c, map, id + " start", n, 0, hovered, color, grip);
            taken |= place_handle(c, map, id + " end", n, 2, hovered, color, grip);
        } else {
            const float reach = 0.3f * static_cast<float>(std::min(plate.width, plate.height));
            const auto angle = static_cast<float>(static_cast<double>(n[0]) * kDegree);
            Vec2 from = middle + aspect.squeezed(Vec2{std::cos(angle), -std::sin(angle)} * reach);
            plate_line(c, map, from, middle, faded(color, 0.7f));
            const Grip now = handle(c, map, id, from, hovered, color);
            if (now == Grip::kHeld || now == Grip::kLetGo) {
                const Vec2 way = aspect.unsqueezed(from - middle);
                n[0] = static_cast<float>(
                    std::atan2(-static_cast<double>(way.y), static_cast<double>(way.x)) / kDegree);
                grip = now;
            }
            taken = now == Grip::kTaken;
        }
        if (taken) c.state.lamp = static_cast<int>(k);
        if (lamps[k].kind == LampKind::kPoint)
            tag(c, map.to_screen({n[0], n[1]}), ("Lamp " + std::to_string(k + 1)).c_str());
        if (grip != Grip::kNone) set_lamp(c, *region, k, n, grip == Grip::kLetGo);
    }
}

}  // namespace weft::ui

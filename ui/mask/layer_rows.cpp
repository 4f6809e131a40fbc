#include "ui/mask/layer_rows.h"

#include "app/mattes/matte_layer.h"
#include "ui/base/icons.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

// "Layer 2" of the holdouts, "Zone 1".
std::string title_of_layer(int layer) {
    return is_zone_layer(layer) ? "Zone " + std::to_string(zone_of_layer(layer) + 1)
                                : "Layer " + std::to_string(layer);
}

std::string name_of_layer(const Ctx& c, const MatteSource& holdout, int layer) {
    const std::string title = title_of_layer(layer);
    for (const Leaf<Region>& other : c.view.project.regions)
        if (!holdout.empty() && *other->matte == holdout) return title + ": " + other->name;
    if (holdout.empty()) return title + ", not painted yet";
    if (!holdout.select.crypto.empty()) return title + ": " + holdout.select.crypto;
    if (!holdout.shape.empty()) return title + ": roto shape";
    if (!holdout.files.empty()) {
        const std::size_t slash = holdout.files.find_last_of('/');
        return title + ": " + holdout.files.substr(slash == std::string::npos ? 0 : slash + 1);
    }
    const std::size_t keys = holdout.keyframes.size();
    return title + ": painted on " + std::to_string(keys) + (keys == 1 ? " frame" : " frames");
}

void remove_layer(Ctx& c, const Region& region, int layer) {
    const RegionRef ref{region.id, {}};
    if (is_zone_layer(layer)) {
        std::vector<Zone> left = *region.zones;
        const int zone = zone_of_layer(layer);
        if (zone >= static_cast<int>(left.size())) return;
        left.erase(left.begin() + zone);
        return c.edit(SetZones{ref, left});
    }
    std::vector<MatteSource> left = *region.holdouts;
    if (layer > static_cast<int>(left.size())) return;
    left.erase(left.begin() + layer - 1);
    c.edit(SetHoldouts{ref, left});
}

}  // namespace

void layer_row(Ctx& c, const Region& region, int layer) {
    const Theme& t = c.theme;
    const MatteSource& painted = layer_source(region, layer);
    const std::string title = title_of_layer(layer);
    const bool chosen = c.view.matte_layer == layer;
    ImGui::PushID(layer);
    const float width = ImGui::GetContentRegionAvail().x - t.px(26) - t.gap;
    const std::string label =
        fitted(name_of_layer(c, painted, layer), width - t.px(36)) + "##" + title;
    if (button(c, label.c_str(),
               {.icon = icons::kBrush,
                .look = chosen ? Look::kPrimary : Look::kNormal,
                .tip = painted.files.empty() ? "Brush, shapes and keyframes edit this layer"
                                             : "Select it to paint over its files",
                .width = width}))
        c.emit(SelectMatteLayer{chosen ? 0 : layer});
    c.note(title);
    ImGui::SameLine();
    const std::string remove =
        is_zone_layer(layer) ? "Remove z" + title.substr(1) : "Remove l" + title.substr(1);
    if (icon_button(c, icons::kClose, remove.c_str(), false, nullptr, true, t.row)) {
        remove_layer(c, region, layer);
        c.emit(SelectMatteLayer{0});
    }
    ImGui::PopID();
}

void back_to_matte(Ctx& c) {
    if (button(c, "Back to the matte",
               {.icon = icons::kArrowLeft,
                .look = Look::kQuiet,
                .tip = "Brush, shapes and keyframes edit the region's own matte",
                .width = -1}))
        c.emit(SelectMatteLayer{0});
}

void begin_layer(Ctx& c, const char* label, const char* tip, SelectMatteLayer begin) {
    if (!button(c, label,
                {.icon = icons::kBrush,
                 .enabled = c.view.plate.state == PlateView::State::kOpen,
                 .tip = tip,
                 .width = -1}))
        return;
    c.emit(begin);
    if (c.state.tool == Tool::kPan) c.state.tool = Tool::kBrush;
}

}  // namespace weft::ui

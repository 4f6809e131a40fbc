#include "app/exchange/flat_picture.h"

namespace weft {
namespace {

std::string size_text(Size size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace

Expected<FlatLayout> flat_layout_of(Size picture, Size plate) {
    FlatLayout out{plate, picture.width >= kMostFlatScale * plate.width ? kMostFlatScale : 1, 0};
    const int wider = picture.width - out.texels_per_px * plate.width;
    out.margin_px = wider / (2 * out.texels_per_px);
    if (out.margin_px >= 0 && 2 * out.margin_px < plate.width && out.size() == picture) return out;
    const Size once = FlatLayout{plate, 1, 0}.size(), twice = FlatLayout{plate, 2, 0}.size();
    return fail(ErrorCode::kUsage,
                "The picture has " + size_text(picture) +
                    " pixels, and a flat picture of this plate has " + size_text(once) + " or " +
                    size_text(twice) + ", or more by the same margin on all sides.",
                "Save it in the size in which it was flattened, neither cropped nor scaled.");
}

Region with_flat_picture(const Region& region, const std::string& path, const FlatLayout& layout,
                         const std::string& space) {
    Region out = region;
    out.texture = {};
    out.texture.plane = path;
    out.texture.wrap = WrapMode::kClamp;
    out.texture.space = space;
    out.amendments = Leaf<std::vector<PlaneAmendment>>();
    out.placement = {};
    out.placement.corners_px.emplace();
    const std::array<Vec2, 4> corners = layout.corners();
    for (std::size_t k = 0; k < corners.size(); ++k)
        (*out.placement.corners_px)[k] = {corners[k].x, corners[k].y};
    LightParams light;
    light.cast = 0;
    light.albedo = region.light.albedo;
    light.lighting = region.light.lighting;
    light.pass_layer = region.light.pass_layer;
    light.extra = region.light.extra;
    out.light = std::move(light);
    out.grade = {};
    out.grade.match = 0;
    out.layer = {};
    return out;
}

}  // namespace weft

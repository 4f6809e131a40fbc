#include "app/shot/shown_sample.h"

#include <algorithm>

#include "engine/pipeline/plate_views.h"
#include "engine/synthesis/sample_cover.h"

namespace weft {
namespace {

void keep_whole_periods(const ColorTransform& display_from_texture, ImageF3& sample) {
    const Recti part = tiling_part(make_views(sample, display_from_texture).display);
    if (part.size() == sample.size()) return;
    ImageF3 out(part.size());
    for (int y = 0; y < out.height(); ++y)
        std::copy_n(sample.pixel(part.x0, part.y0 + y), 3 * out.width(), out.pixel(0, y));
    sample = std::move(out);
}

}  // namespace

void show_sample(const Recti& box, const ColorTransform& display_from_texture,
                 TexturePicture& texture, RegionPlan& plan) {
    switch (plan.mode) {
        case PlaneMode::kMirror:
            texture.wrap = WrapMode::kMirror;
            break;
        case PlaneMode::kStretch: {
            texture.wrap = WrapMode::kClamp;
            plan.placement.picture_texels = texture.pixels.size();
            if (!plan.placement.corners)
                plan.placement.corners = {Vec2(box.x0, box.y0), Vec2(box.x1, box.y0),
                                          Vec2(box.x1, box.y1), Vec2(box.x0, box.y1)};
            break;
        }
        default:
            texture.wrap = WrapMode::kRepeat;
            keep_whole_periods(display_from_texture, texture.pixels);
            break;
    }
}

}  // namespace weft

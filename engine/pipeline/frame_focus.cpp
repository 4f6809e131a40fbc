#include "engine/pipeline/frame_focus.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/composite/focus.h"
#include "engine/composite/focus_map.h"
#include "engine/core/blur_inside.h"
#include "engine/core/luma.h"
#include "engine/lighting/shading_lookup.h"

namespace weft {
namespace {

constexpr float kSoftEdge = 0.015f;  // gradient of an edge that is out of focus
constexpr float kLightShare = 0.3f;  // of an edge's step, from which it is an edge of light
constexpr float kLeastLight = 1e-5f;

// The shading over the box, at full size.
ImageF1 light_over(const Shading& shading, const Recti& box) {
    ImageF1 out(box.size());
    std::vector<float> scratch, row(static_cast<std::size_t>(box.width()));
    for (int y = 0; y < box.height(); ++y) {
        shading_row(shading, box.x0, box.y0 + y, scratch, row);
        std::copy(row.begin(), row.end(), out.row(y));
    }
    return out;
}

// Whether light explains most of an edge's step. The shading is taken a pixel of it further out,
// since it is that much softer than the plate.
bool is_light(const EdgeBlur& edge, ViewF3 plate, const ImageF1& light, int reach) {
    const auto ln = [](float v) { return std::log(std::max(v, kLeastLight)); };
    const auto sign = [](int v) { return (v > 0 ? 1 : 0) - (v < 0 ? 1 : 0); };
    const Vec2i way = edge.bright - edge.dark;
    const Vec2i out{reach * sign(way.x), reach * sign(way.y)};
    const auto light_at = [&](Vec2i p) {
        return ln(light.at(std::clamp(p.x, 0, light.width() - 1),
                           std::clamp(p.y, 0, light.height() - 1)));
    };
    const auto luma_at = [&](Vec2i p) { return ln(luma_709(plate.pixel(p.x, p.y))); };
    const float of_light = light_at(edge.bright + out) - light_at(edge.dark - out);
    return of_light > kLightShare * (luma_at(edge.bright) - luma_at(edge.dark));
}

// The plate's blur over the box, if it varies over the picture. `edges`: the plate's there.
Expected<std::optional<ImageF1>> local_blur(const FrameLightInputs& in,
                                            const std::vector<EdgeBlur>& edges) {
    using Found = Expected<std::optional<ImageF1>>;
    if (!in.plan.regions[static_cast<std::size_t>(in.index)].has_depth)
        return Found(sloping_blur(edges, in.box.size()));
    WEFT_TRY(nearness, in.source.depth(in.index, in.frame));
    // There is one lens, so the whole plate is measured; the region alone shows too little detail.
    const Matte everywhere(in.working.size(), 255);
    const auto lens = fit_focus(edge_blurs(in.working, everywhere, kSoftEdge), nearness);
    if (!lens) return Found(std::nullopt);
    ImageF1 blur(in.box.size());
    for (int y = 0; y < blur.height(); ++y) {
        for (int x = 0; x < blur.width(); ++x)
            blur.row(y)[x] = lens->blur_px(nearness.row(in.box.y0 + y)[in.box.x0 + x]);
    }
    return Found(std::move(blur));
}

// The plate's edges in the box that are paint.
PictureEdges paint_edges(const FrameLight& light, ViewF3 plate, ViewU8x1 inside) {
    PictureEdges out = picture_edges(plate, inside, kSoftEdge);
    if (const auto& shading = light.shading()) {
        const ImageF1 there = light_over(*shading, light.inputs().box);
        std::erase_if(out.edges, [&](const EdgeBlur& edge) {
            return is_light(edge, plate, there, shading->downscale);
        });
    }
    return out;
}

}  // namespace

Status match_focus(const FrameLight& light, ViewU8x1 inside, ImageF3& texture) {
    const FrameLightInputs& in = light.inputs();
    const RegionPlan& region = in.plan.regions[static_cast<std::size_t>(in.index)];
    if (!(region.focus > 0)) return {};
    const PictureEdges of_plate =
        paint_edges(light, in.working.view().crop(in.box), light.on_surface(inside));
    const float plate_px = strong_blur_px(of_plate);
    WEFT_TRY(local, local_blur(in, of_plate.edges));
    // A lens that was fitted to the whole plate needs no evidence from the region.
    const float sure = local && region.has_depth ? 1.0f : blur_confidence(of_plate);
    const float strength = sure * region.focus;
    const bool sharp = !local && !(blur_between(kSharpestEdge_px, plate_px) > 0);
    if (!(strength > 0) || sharp) return {};
    const float own_px = edge_blur_px(texture, inside);
    if (!(own_px > 0)) return {};
    const float needed_px = blur_to_match(texture, inside, own_px, plate_px);
    if (!local) {
        if (needed_px > 0) blur_inside(texture, inside, strength * needed_px);
        return {};
    }
    const float even_px = blur_between(own_px, plate_px);
    const float again = even_px > 0 ? needed_px / even_px : 1.0f;
    for (int y = 0; y < local->height(); ++y) {
        for (int x = 0; x < local->width(); ++x) {
            float& blur = local->row(y)[x];
            blur = strength * again * blur_between(own_px, blur);
        }
    }
    blur_by_map(texture, inside, *local);
    return {};
}

}  // namespace weft

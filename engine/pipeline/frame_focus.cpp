#include "engine/pipeline/frame_focus.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/color/grade.h"
#include "engine/composite/focus.h"
#include "engine/composite/focus_map.h"
#include "engine/compute/plane_sampler.h"
#include "engine/core/blur_inside.h"
#include "engine/pipeline/focus_pass.h"
#include "engine/pipeline/plate_views.h"
#include "engine/temporal/placement.h"

namespace weft {
namespace {

// A blur that varies by less from one end of the region to the other is one blur.
constexpr float kEven_px = 0.02f;
// The part of the texture that is measured.
constexpr Size kMeasured{512, 288};

// The middle of the region, no larger than kMeasured, inside the frame.
Recti measured_part(const Matte& extent) {
    Recti box = matte_bounds(extent);
    if (box.empty()) box = rect_of(extent.size());
    const Vec2i middle((box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2);
    const auto about = [](int at, int length, int most, int end) {
        const int side = std::min({std::max(length, 64), most, end});
        const int first = std::clamp(at - side / 2, 0, end - side);
        return std::pair(first, first + side);
    };
    const auto [x0, x1] = about(middle.x, box.width(), kMeasured.width, extent.width());
    const auto [y0, y1] = about(middle.y, box.height(), kMeasured.height, extent.height());
    return {x0, y0, x1, y1};
}

// Texels for a pixel's side, as the root of the area, on the mean over the box where `counts`; 0 if
// it is nowhere known.
template <class Counts>
float texels_per_px(const LatticeField& ref_from_cur, const TextureMapping& mapping,
                    const Recti& box, Counts&& counts) {
    constexpr int kSide = 12;
    double sum = 0;
    int n = 0;
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
            const int x = box.x0 + (2 * i + 1) * box.width() / (2 * kSide);
            const int y = box.y0 + (2 * j + 1) * box.height() / (2 * kSide);
            if (!counts(x, y)) continue;
            const auto texel = [&](Vec2 p) { return mapping.texel(p + ref_from_cur.at(p)); };
            const Vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            const Vec2 u = texel(p + Vec2(1, 0)) - texel(p - Vec2(1, 0));
            const Vec2 v = texel(p + Vec2(0, 1)) - texel(p - Vec2(0, 1));
            const float area = std::abs(u.x * v.y - u.y * v.x) / 4;
            if (!std::isfinite(area) || !(area > 0)) continue;
            sum += static_cast<double>(std::sqrt(area));
            ++n;
        }
    }
    return n == 0 ? 0.0f : static_cast<float>(sum / n);
}

// How much larger the texture is shown than where it was measured.
Expected<float> shown_times(const FrameLightInputs& in, ViewU8x1 inside) {
    const RegionPlan& region = in.plan.regions[static_cast<std::size_t>(in.index)];
    WEFT_TRY(mapping, mapping_on(region, in.scene, in.frame));
    LatticeField ref_from_cur(in.working.size(), 64);
    if (region.temporal == TemporalMode::kLocked) {
        WEFT_TRY(bytes, in.store.get({in.index, in.frame, AnalysisKind::kCoords}));
        WEFT_TRY(stored, decode_lattice(bytes));
        ref_from_cur = std::move(stored);
    }
    const float now = texels_per_px(ref_from_cur, mapping, in.box, [&](int x, int y) {
        return inside.row(y - in.box.y0)[x - in.box.x0] >= 128;
    });
    return now > 0 ? in.scene.focus_texels_per_px / now : 1.0f;
}

// How a texture answers to blurs on this frame.
struct Shown {
    TextureFocus texture;
    float times = 1;
};

Expected<Shown> shown_texture(const FrameLightInputs& in, ViewU8x1 inside, const ImageF3& texture) {
    const RegionPlan& region = in.plan.regions[static_cast<std::size_t>(in.index)];
    if (!is_focus_followed(region)) return Shown{texture_focus(texture), 1};
    WEFT_TRY(times, shown_times(in, inside));
    return Shown{in.scene.focus, times};
}

// The blur of the plate at each pixel of the box; empty: one for all.
Expected<ImageF1> blur_over(const FrameLightInputs& in, const FocusState& plate) {
    const Recti& box = in.box;
    if (!plate.lenses.empty()) {
        WEFT_TRY(nearness, in.source.depth(in.index, in.frame));
        ImageF1 out(box.size());
        for (int y = 0; y < out.height(); ++y) {
            for (int x = 0; x < out.width(); ++x)
                out.row(y)[x] = plate.lens_blur_px(nearness.row(box.y0 + y)[box.x0 + x]);
        }
        return out;
    }
    const BlurSlope& slope = plate.slope;
    if (!(slope.agreement * (slope.most_px - slope.least_px) > kEven_px)) return ImageF1();
    ImageF1 out(box.size());
    const float even = plate.blur_px * plate.blur_px;
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const float local = slope.variance(static_cast<float>(box.x0 + x) + 0.5f,
                                               static_cast<float>(box.y0 + y) + 0.5f);
            out.row(y)[x] = std::sqrt(even + slope.agreement * (local - even));
        }
    }
    return out;
}

}  // namespace

bool is_focus_followed(const RegionPlan& region) {
    return region.focus > 0 && has_plane(region) && !region.has_uv;
}

void take_texture_focus(const ShotPlan& plan, const RegionPlan& region, const Matte& extent,
                        RegionScene& scene) {
    const Recti part = measured_part(extent);
    const LatticeField still(extent.size(), 64);
    const Matte all(part.size(), 255);
    const TextureCoords at = texture_coords(still, scene.mapping, part);
    SampleRequest request;
    request.plane = &scene.plane;
    request.matte = all;
    request.coords = at.uv;
    request.quality =
        plan.quality == FlowQuality::kDraft ? SampleQuality::kDraft : SampleQuality::kFinal;
    ImageF3 texture(part.size());
    sample_plane_cpu(request, texture);
    apply_grade(texture, all, grade_on(region, scene));
    scene.focus = texture_focus(texture);
    scene.focus_texels_per_px =
        texels_per_px(still, scene.mapping, part, [](int, int) { return true; });
}

Status match_focus(const FrameLight& light, ViewU8x1 inside, ImageF3& texture) {
    const FrameLightInputs& in = light.inputs();
    const RegionPlan& region = in.plan.regions[static_cast<std::size_t>(in.index)];
    if (!(region.focus > 0)) return {};
    WEFT_TRY(plate, focus_on(in.plan, in.store, in.index, in.frame));
    WEFT_TRY(local, blur_over(in, plate));
    const float strength = region.focus * (plate.lenses.empty() ? plate.confidence : 1.0f);
    const bool sharp = local.empty() && !(blur_between(kSharpestEdge_px, plate.blur_px) > 0);
    if (!(strength > 0) || sharp) return {};
    WEFT_TRY(shown, shown_texture(in, inside, texture));
    if (!(shown.texture.own_px > 0)) return {};
    if (local.empty()) {
        const float needed_px = strength * shown.texture.needed_px(shown.times, plate.blur_px);
        if (needed_px > 0) blur_inside(texture, inside, needed_px);
        return {};
    }
    for (int y = 0; y < local.height(); ++y) {
        for (int x = 0; x < local.width(); ++x) {
            float& blur = local.row(y)[x];
            blur = strength * shown.texture.needed_px(shown.times, blur);
        }
    }
    blur_by_map(texture, inside, local);
    return {};
}

}  // namespace weft

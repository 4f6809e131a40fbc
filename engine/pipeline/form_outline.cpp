#include "engine/pipeline/form_outline.h"

#include <algorithm>
#include <cmath>

#include "engine/core/setting.h"
#include "engine/form/flatten.h"
#include "engine/form/form_relief.h"
#include "engine/form/inflate.h"

namespace weft {
namespace {

constexpr double kCommonFov_deg = 49;
// Of a roundness of 1: bodies and folded cloth are flatter than wide. With it the texture of a
// column is laid better, and that of a torso not worse than flat (docs/EVIDENCE.md).
constexpr double kUsual = 0.5;
constexpr double kReach = 0.02;  // of the picture's longer side, from a cut stroke
constexpr int kNear = 6;         // px, the least such distance

Recti box_of(const Matte& matte) {
    Recti out{};
    for (int y = 0; y < matte.height(); ++y)
        for (int x = 0; x < matte.width(); ++x)
            if (matte.row(y)[x] >= 128) out = out.united({x, y, x + 1, y + 1});
    return out;
}

// The distance of a place from a line between two ends, px.
double distance_to(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
    const glm::dvec2 d = b - a, v = p - a;
    const double along = std::clamp((v.x * d.x + v.y * d.y) / (d.x * d.x + d.y * d.y), 0.0, 1.0);
    const glm::dvec2 off = v - along * d;
    return std::sqrt(off.x * off.x + off.y * off.y);
}

// Marks what lies near a line. Returns whether the matte's outline is among it.
bool mark(glm::dvec2 a, glm::dvec2 b, double reach, const Matte& extent, Matte& cut) {
    const auto floor_of = [](double v) { return static_cast<int>(std::floor(v)); };
    const Recti around =
        Recti{floor_of(std::min(a.x, b.x) - reach), floor_of(std::min(a.y, b.y) - reach),
              floor_of(std::max(a.x, b.x) + reach) + 1, floor_of(std::max(a.y, b.y) + reach) + 1}
            .intersected(rect_of(extent.size()));
    bool inside = false, outside = false;
    for (int y = around.y0; y < around.y1; ++y) {
        for (int x = around.x0; x < around.x1; ++x) {
            if (distance_to(a, b, {x + 0.5, y + 0.5}) > reach) continue;
            cut.row(y)[x] = 255;
            (extent.row(y)[x] >= 128 ? inside : outside) = true;
        }
    }
    return inside && outside;
}

Expected<Matte> cuts_of(const RegionPlan& region, const Matte& extent) {
    Matte out(extent.size());
    const double reach =
        std::max<double>(kNear, kReach * std::max(extent.width(), extent.height()));
    for (const FormGuide& stroke : region.form_guides) {
        if (stroke.kind != FormGuideKind::kCut) continue;
        for (std::size_t k = 0; k < stroke.numbers.size(); k += 4) {
            if (mark(stroke.place(k), stroke.place(k + 2), reach, extent, out)) continue;
            return fail(ErrorCode::kUsage,
                        "A cut stroke lies off the region's outline on its reference frame.",
                        "Draw it along the outline" + by({{setting::kFormStrokes}}) + ".");
        }
    }
    return out;
}

}  // namespace

Expected<FormMap> form_from_outline(const FormEvidence& evidence, const Matte& extent, Size plate,
                                    const RegionPlan& region) {
    WEFT_TRY(cut, cuts_of(region, extent));
    const double fov_deg = region.form_fov_deg.value_or(kCommonFov_deg);
    const Recti box = box_of(extent);
    const int side = std::max(box.width(), box.height());
    MetricField field = field_over(
        plate, box.grown(std::min(std::max(plate.width, plate.height) / 2, side / 4 + 8)));
    const bool round =
        add_inflated(field, extent, cut, evidence.visible, camera_with(fov_deg, plate),
                     kUsual * static_cast<double>(region.form_roundness));
    if (!round || !field.finish()) {
        return fail(ErrorCode::kUsage,
                    "The region's outline on its reference frame turns away nowhere, or its matte "
                    "is too small, so there is nothing to inflate.",
                    "Choose another reference frame" + by({{setting::kReferenceFrame}}) +
                        ", another source" + by({{setting::kFormSource}}) +
                        ", or remove cut strokes" + by({{setting::kFormStrokes}}) + ".");
    }
    FormMap out = flat_from_reference(field);
    out.finding = {FormFinding::Source::kOutline, false, 1};
    if (region.form_fov_deg) out.finding.fov_deg = static_cast<float>(fov_deg);
    add_relief(out, field, fov_deg, plate, false);
    return out;
}

}  // namespace weft

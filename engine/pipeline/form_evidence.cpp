#include "engine/pipeline/form_evidence.h"

#include <algorithm>
#include <cmath>

#include "engine/core/unsqueezed_image.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

// About a hundred cells across the plate: finer than the folds that a texture can follow.
constexpr int kCells = 108, kLeastSpacing_px = 4;
constexpr double kMostPlates = 4;  // of the domain's area, at that spacing

int spacing_for(Size plate, Size domain) {
    const int side = std::max(plate.width, plate.height);
    const int spacing = std::max(kLeastSpacing_px, (side + kCells - 1) / kCells);
    const double plates = static_cast<double>(domain.width) * domain.height /
                          (static_cast<double>(plate.width) * plate.height);
    const double wider = std::sqrt(std::max(1.0, plates / kMostPlates));
    return static_cast<int>(std::ceil(spacing * wider));
}

Expected<FormEvidence> form_evidence_at(const PassContext& context, const AnalysisStore& store,
                                        int region, int frame) {
    WEFT_TRY(extent, extent_matte(context.source, context.plan, store, region, frame));
    WEFT_TRY(holdout, holdout_matte(context.source, context.plan, store, region, frame));
    WEFT_TRY(bytes, store.get({region, frame, AnalysisKind::kCoords}));
    WEFT_TRY(field, decode_lattice(bytes));
    const PixelAspect aspect = region_of(context.plan, region).placement.aspect;
    return FormEvidence{unsqueezed(without_holdout(extent, holdout), aspect),
                        unsqueezed(field, aspect)};
}

// Where a frame's visible surface lies on the reference frame's plane, at most a plate beyond it.
Recti place_of(const FormEvidence& at) {
    constexpr int kStep = 8;
    const Size size = at.visible.size();
    const Recti most{-size.width, -size.height, 2 * size.width, 2 * size.height};
    Recti out{};
    for (int y = kStep / 2; y < size.height; y += kStep) {
        for (int x = kStep / 2; x < size.width; x += kStep) {
            if (at.visible.row(y)[x] < 128) continue;
            const Vec2 p(static_cast<float>(x), static_cast<float>(y));
            const Vec2 q = p + at.ref_from_cur.at(p);
            if (!(std::abs(q.x) < 1e6f && std::abs(q.y) < 1e6f)) continue;
            const int qx = static_cast<int>(std::floor(q.x)),
                      qy = static_cast<int>(std::floor(q.y));
            out = out.united(Recti{qx, qy, qx + 1, qy + 1}.grown(kStep).intersected(most));
        }
    }
    return out;
}

}  // namespace

Expected<std::vector<FormEvidence>> form_evidence_on(const PassContext& context,
                                                     const AnalysisStore& store, int region,
                                                     const std::vector<int>& frames) {
    std::vector<FormEvidence> out;
    for (const int frame : frames) {
        if (context.cancel.cancelled()) return cancelled(context.cancel);
        WEFT_TRY(at, form_evidence_at(context, store, region, frame));
        out.push_back(std::move(at));
    }
    return out;
}

MetricField field_over(Size plate, const std::vector<FormEvidence>& evidence) {
    Recti domain = rect_of(plate);
    for (const FormEvidence& at : evidence)
        domain = domain.united(place_of(at));
    return field_over(plate, domain);
}

MetricField field_over(Size plate, const Recti& domain) {
    return {plate, domain, spacing_for(plate, domain.size())};
}

}  // namespace weft

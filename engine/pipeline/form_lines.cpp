#include "engine/pipeline/form_lines.h"

#include <algorithm>

#include "engine/core/unsqueezed_image.h"
#include "engine/form/form_level.h"
#include "engine/form/plane_in_picture.h"
#include "engine/pipeline/form_laid.h"
#include "engine/pipeline/plate_views.h"

namespace weft {
namespace {

constexpr int kFewFrames = 2;  // that motion needs beside the reference frame
constexpr double kLeastBelieved = 0.6;
constexpr double kBeliefOfMoving = 0.8;  // of what does not move as a rigid thing

// Whether its motion is no rigid thing's, as far as tracks are right.
bool seems_to_bend(const FormFinding& moved) {
    return moved.frames >= kFewFrames && !moved.no_parallax && !(moved.fov_deg > 0);
}

TangentBelief lens_before(const MotionLens& lens, Size plate) {
    if (const auto tangent = tangent_of(lens.fov_deg, plate))
        return {*tangent, kGivenTangentDeviation};
    return lens.shared.value_or(TangentBelief());
}

FormFinding finding_of(const PictureFit& fit, const MotionLens& lens) {
    FormFinding out{FormFinding::Source::kLines,
                    true,
                    1,
                    static_cast<float>(fit.belief),
                    static_cast<float>(fit.tilt_deg),
                    static_cast<float>(fit.tilt_error_deg),
                    static_cast<float>(fit.fov_deg)};
    if (!lens.fov_deg) out.fov_error_deg = static_cast<float>(fit.fov_error_deg);
    return out;
}

}  // namespace

Expected<FormMap> form_from_lines(const PassContext& context, int region,
                                  const std::vector<FormEvidence>& evidence, const MotionLens& lens,
                                  FormMap moved) {
    const RegionPlan& plan = context.plan.regions[static_cast<std::size_t>(region)];
    if (moved.finding.source != FormFinding::Source::kNone || !may_be_plane(plan.surface))
        return moved;
    const Matte& visible = evidence.front().visible;
    if (matte_bounds(visible).empty()) return moved;
    WEFT_TRY(plate, context.source.plate(plan.reference_frames.front()));
    const PlateViews views = make_views(*plate, *context.plan.display_from_plate);
    const std::vector<PictureLine> lines =
        picture_lines(unsqueezed(views.luma, plan.placement.aspect));
    if (context.cancel.cancelled()) return cancelled(context.cancel);
    const ScenePerspective scene =
        scene_perspective(lines, visible.size(), lens_before(lens, visible.size()));
    const auto fit = plane_in_picture(scene, lines_on(lines, visible), visible);
    const double least = seems_to_bend(moved.finding) ? kBeliefOfMoving : kLeastBelieved;
    if (!fit || !fit->holds(least)) return moved;
    FormMap out = laid_flat(fit->surface, finding_of(*fit, lens), evidence, visible.size());
    turn_square(out, fit->surface.centre, fit->along);
    return out;
}

}  // namespace weft

#include "engine/pipeline/form_pass.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/core/setting.h"
#include "engine/core/unsqueezed_image.h"
#include "engine/form/flatten.h"
#include "engine/form/form_relief.h"
#include "engine/form/normal_metric.h"
#include "engine/form/position_metric.h"
#include "engine/pipeline/form_drawn.h"
#include "engine/pipeline/form_evidence.h"
#include "engine/pipeline/form_lens.h"
#include "engine/pipeline/form_lines.h"
#include "engine/pipeline/form_motion.h"
#include "engine/pipeline/form_outline.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

std::string text_of(const std::vector<int>& frames) {
    const auto [first, last] = std::minmax_element(frames.begin(), frames.end());
    if (*first == *last) return "frame " + std::to_string(*first);
    return "frames " + std::to_string(*first) + " to " + std::to_string(*last);
}

tl::unexpected<Error> no_form(const std::vector<int>& frames, RegionPlan::FormFrom from) {
    if (from == RegionPlan::FormFrom::kNormals) {
        return fail(ErrorCode::kUnreadable,
                    "The normal pass shows no form on " + text_of(frames) +
                        ": inside the matte its normals are zero or not finite.",
                    "Choose the layer with the normals of this surface" +
                        by({{setting::kNormalLayer}}) + ", or leave the pass out.");
    }
    return fail(ErrorCode::kUnreadable,
                "The position pass shows no form on " + text_of(frames) +
                    ": inside the matte its places are constant, on one line or not finite.",
                "Choose the layer with the places of this surface" +
                    by({{setting::kPositionLayer}}) + ", or leave the pass out.");
}

double fov_of(const ViewCamera& camera, Size picture) {
    const long double half = 0.5L * picture.width / static_cast<long double>(camera.focal_px);
    return static_cast<double>(2 * std::atan(half) * 180 / std::numbers::pi_v<long double>);
}

// Adds what a frame's pass shows. The horizontal field of view, if it has to be known for that; 0:
// not.
Expected<double> add_pass(const PassContext& context, int region, int frame, const FormEvidence& at,
                          double weight, MetricField& field) {
    const RegionPlan& plan = context.plan.regions[static_cast<std::size_t>(region)];
    if (plan.form_from == RegionPlan::FormFrom::kPositions) {
        WEFT_TRY(squeezed, context.source.positions(region, frame));
        const ImageF3 positions = unsqueezed(std::move(squeezed), plan.placement.aspect);
        add_positions(field, positions, at.visible, at.ref_from_cur, weight);
        return 0.0;
    }
    WEFT_TRY(pass, context.source.normals(region, frame));
    pass.normals = unsqueezed(std::move(pass.normals), plan.placement.aspect);
    const auto normals =
        view_normals(pass.normals, at.visible, pass.camera, pass.camera_from_world);
    if (!normals) {
        return fail(ErrorCode::kUnreadable,
                    "Many normals of the normal pass face away from the camera on frame " +
                        std::to_string(frame) + ", so they are not in the axes that are set.",
                    "Set the space they are in" +
                        by({{setting::kNormalSpace, "camera"}, {setting::kNormalSpace, "world"}}) +
                        ".");
    }
    add_normals(field, *normals, at.visible, pass.camera, at.ref_from_cur, weight);
    return fov_of(pass.camera, at.visible.size());
}

// What the region's own source says of its form.
Expected<FormMap> form_as_found(const PassContext& context, const AnalysisStore& store, int region,
                                const std::vector<int>& frames,
                                const std::vector<FormEvidence>& evidence, MotionLens lens) {
    const RegionPlan& plan = context.plan.regions[static_cast<std::size_t>(region)];
    const Size picture = evidence.front().visible.size();
    if (plan.form_from == RegionPlan::FormFrom::kMotion) {
        lens.fov_deg = plan.form_fov_deg;
        return form_from_lines(context, region, evidence, lens,
                               form_from_motion(evidence, picture, lens));
    }
    if (plan.form_from == RegionPlan::FormFrom::kShape)
        return form_from_drawing(evidence.front(), picture, plan);
    if (plan.form_from == RegionPlan::FormFrom::kOutline) {
        WEFT_TRY(extent, extent_matte(context.source, context.plan, store, region, frames.front()));
        return form_from_outline(
            evidence.front(), unsqueezed(std::move(extent), plan.placement.aspect), picture, plan);
    }
    MetricField field = field_over(picture, evidence);
    double fov_deg = plan.form_fov_deg.value_or(0);
    for (std::size_t k = 0; k < frames.size(); ++k) {
        if (context.cancel.cancelled()) return cancelled(context.cancel);
        WEFT_TRY(known, add_pass(context, region, frames[k], evidence[k], k == 0 ? 1 : kOtherFrames,
                                 field));
        if (k == 0 && known > 0) fov_deg = known;
    }
    if (!field.finish()) return no_form(frames, plan.form_from);
    FormMap out = flat_from_reference(field);
    out.finding = {FormFinding::Source::kPass, false, static_cast<int>(frames.size())};
    add_relief(out, field, fov_deg > 0 ? fov_deg : fov_of_metric(field, picture), picture, false);
    return out;
}

AnalysisKey form_key(const ShotPlan& plan, int region) {
    const auto& references = plan.regions[static_cast<std::size_t>(region)].reference_frames;
    return {region, references.front(), AnalysisKind::kForm};
}

}  // namespace

Expected<FormMap> form_from(const PassContext& context, const AnalysisStore& store, int region,
                            const std::vector<int>& frames, const MotionLens& lens) {
    const RegionPlan& plan = context.plan.regions[static_cast<std::size_t>(region)];
    WEFT_TRY(evidence, form_evidence_on(context, store, region, frames));
    WEFT_TRY(form, form_as_found(context, store, region, frames, evidence, lens));
    WEFT_CHECK_OK(level_form(evidence.front(), plan, form));
    form.aspect = plan.placement.aspect;
    return form;
}

bool lacks_form(const ShotPlan& plan, const AnalysisStore& store, int region) {
    return plan.regions[static_cast<std::size_t>(region)].has_form() &&
           !store.has(form_key(plan, region));
}

int count_form_steps(const ShotPlan& plan, const AnalysisStore& store) {
    int out = 0;
    for (int k = 0; k < static_cast<int>(plan.regions.size()); ++k)
        out += lacks_form(plan, store, k);
    return out;
}

Status find_forms(const PassContext& context, AnalysisStore& store) {
    if (count_form_steps(context.plan, store) == 0) return {};
    WEFT_TRY(lens, shared_lens(context, store));
    for (int k = 0; k < static_cast<int>(context.plan.regions.size()); ++k) {
        if (!lacks_form(context.plan, store, k)) continue;
        const AnalysisKey key = form_key(context.plan, k);
        const auto start = std::chrono::steady_clock::now();
        const auto& evidence = context.plan.regions[static_cast<std::size_t>(k)].form_evidence;
        WEFT_TRY(form, form_from(context, store, k, evidence, lens));
        WEFT_CHECK_OK(store.put(key, encode(form)));
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        if (context.step) context.step(key.frame, taken.count());
    }
    return {};
}

}  // namespace weft

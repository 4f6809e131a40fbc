#include "app/shot/region_projection.h"

#include <algorithm>
#include <array>
#include <limits>

#include "app/shot/form_files.h"
#include "engine/core/setting.h"
#include "engine/media/sequence_pattern.h"

namespace weft {
namespace {

// Lower limit of the gain on a display-referred plate: about 1/100 of the light remains on a
// surface that faces away from the sun.
constexpr float kLeastGain = 1.0f / 64;

MatteReach reach_of(const MatteSource& matte) {
    MatteReach reach;
    reach.direction = matte.propagate_direction;
    if (matte.propagate_from) reach.first = *matte.propagate_from;
    if (matte.propagate_to) reach.last = *matte.propagate_to;
    return reach;
}

std::vector<int> confirmed_frames(const MatteSource& matte) {
    std::vector<int> frames;
    for (const auto& [frame, edge] : matte.confirmed)
        if (!matte.keyframes.contains(frame)) frames.push_back(frame);
    return frames;
}

PaintedMatte painted_matte(const MatteSource& matte) {
    PaintedMatte painted;
    for (const auto& [frame, key] : matte.keyframes)
        painted.keys.push_back(frame);
    painted.steadiness = static_cast<float>(matte.steadiness);
    painted.reach = reach_of(matte);
    painted.edge = project_edge(matte.edge);
    painted.confirmed = confirmed_frames(matte);
    return painted;
}

Vec2 point(const PlatePoint& p) {
    return {p.x, p.y};
}

PlanePlacement plane_placement(const Placement& p) {
    PlanePlacement out;
    out.scale = static_cast<float>(p.scale);
    out.rotate_deg = static_cast<float>(p.rotate_deg);
    out.offset_px = point(p.offset_px);
    if (p.corners_px) {
        out.corners.emplace();
        std::transform(p.corners_px->begin(), p.corners_px->end(), out.corners->begin(), point);
    }
    return out;
}

Status project_warp(const Placement& placement, TemporalMode mode, RegionPlan& plan) {
    if (!placement.warp) return {};
    if (mode != TemporalMode::kLocked || !placement.uv.empty()) {
        return fail(ErrorCode::kUsage,
                    "A grid warp needs the locked temporal mode, and no UV pass beside it, which "
                    "gives the exact place already.",
                    "Set the mode" + by({{setting::kTemporalMode, "locked"}}) +
                        ", or remove the warp" + by({{setting::kWarp, "none"}}) + ".");
    }
    if (auto checked = check_grid_warp(*placement.warp); !checked)
        return fail_in(std::move(checked).error(), "grid warp");
    plan.warp = placement.warp;
    const int first = plan.warp->moves() ? plan.warp->keys.front().first : 0;
    plan.placement.warp = std::make_shared<const PlaneWarp>(*plan.warp, first);
    return {};
}

}  // namespace

MatteEdgePlan project_edge(const MatteEdgeParams& edge) {
    MatteEdgePlan plan;
    plan.edge = {.min_island_px = edge.min_island_px,
                 .min_hole_px = edge.min_hole_px,
                 .smooth_px = static_cast<float>(edge.smooth_px),
                 .choke_px = static_cast<float>(edge.choke_px),
                 .feather_px = static_cast<float>(edge.feather_px),
                 .blur_px = static_cast<float>(edge.blur_px)};
    plan.choke_keys = edge.choke_keys;
    plan.feather_keys = edge.feather_keys;
    plan.blur_keys = edge.blur_keys;
    return plan;
}

Status add_frozen_mattes(Region& region) {
    if (region.matte->frozen.empty()) return {};
    if (region.matte->frozen_files.empty() || region.matte->by_frame()) {
        return fail(ErrorCode::kUsage, "Frozen mattes need their files and painted keyframes.",
                    "Set both" + by({{setting::kMatteFrozenFiles}, {setting::kMatte}}) + ".");
    }
    WEFT_TRY(pattern, SequencePattern::parse(region.matte->frozen_files));
    region.matte = region.matte.with([&](MatteSource& matte) {
        for (const int frame : matte.frozen)
            matte.keyframes.try_emplace(frame, MatteKeyframe{pattern.path_for(frame), {}});
    });
    return {};
}

Status project_mattes(const MatteSource& matte, const std::vector<MatteSource>& holdouts,
                      RegionPlan& plan) {
    if (matte.empty()) {
        return fail(ErrorCode::kUsage, "It has no matte.",
                    "Give files or painted keyframes" + by({{setting::kMatte}}) + ".");
    }
    for (const auto& [frame, key] : matte.keyframes)
        plan.matte_keys.push_back(frame);
    if (!matte.keyframes.empty()) plan.matte_confirmed = confirmed_frames(matte);
    plan.matte_steadiness = static_cast<float>(matte.steadiness);
    plan.matte_reach = reach_of(matte);
    plan.matte_edge = project_edge(matte.edge);
    // Painted holdouts are numbered in order; the number is their key in the analysis.
    for (const MatteSource& holdout : holdouts) {
        if (holdout.by_frame()) {
            plan.has_holdout = true;
            plan.given_holdout_edges.push_back(project_edge(holdout.edge));
            continue;
        }
        if (holdout.keyframes.empty()) {
            return fail(
                ErrorCode::kUsage, "A holdout has no matte.",
                "Give files or painted keyframes" + by({{setting::kHoldout}}) + ", or remove it.");
        }
        plan.painted_holdouts.push_back(painted_matte(holdout));
    }
    return {};
}

Status project_zones(const std::vector<Zone>& zones, RegionPlan& plan) {
    for (const Zone& zone : zones) {
        if (zone.matte.empty()) {
            return fail(
                ErrorCode::kUsage, "A zone has no matte.",
                "Give files or painted keyframes" + by({{setting::kZone}}) + ", or remove it.");
        }
        ZonePlan planned;
        planned.kind = zone.kind;
        if (!zone.matte.by_frame()) planned.painted = painted_matte(zone.matte);
        planned.value = static_cast<float>(zone.value);
        planned.value_keys = zone.value_keys;
        planned.edge = project_edge(zone.matte.edge);
        plan.zones.push_back(std::move(planned));
    }
    return {};
}

void project_corrections(const std::map<int, std::vector<CorrectionPin>>& corrections,
                         RegionPlan& plan) {
    auto& frames = plan.reference_frames;
    for (const auto& [frame, pins] : corrections) {
        for (const CorrectionPin& pin : pins)
            plan.corrections[frame].push_back({point(pin.from), point(pin.to)});
        if (std::find(frames.begin(), frames.end(), frame) == frames.end()) frames.push_back(frame);
    }
}

Status project_motion(const MotionSource& motion, RegionPlan& plan) {
    plan.true_motion = !motion.files.empty();
    plan.motion_forward = motion.direction == MotionDirection::kForward;
    if (motion.track.empty() || !plan.true_motion) return {};
    return fail(ErrorCode::kUsage, "It has both a planar track and motion files.",
                "Keep one of the two" + by({{setting::kTrack}, {setting::kMotion}}) + ".");
}

Status project_placement(const Placement& placement, TemporalMode mode, PixelAspect aspect,
                         RegionPlan& plan) {
    plan.placement = plane_placement(placement);
    plan.placement.aspect = aspect;
    plan.scale_keys = placement.scale_keys;
    plan.rotate_keys = placement.rotate_keys;
    plan.offset_keys = placement.offset_keys;
    if (plan.placement_moves() && mode != TemporalMode::kLocked) {
        return fail(ErrorCode::kUsage,
                    "An animated placement needs the locked temporal mode; the other modes "
                    "synthesize the texture in place.",
                    "Set it" + by({{setting::kTemporalMode, "locked"}}) + ".");
    }
    if (!plan.scale_keys.empty()) {
        const auto& keys = plan.scale_keys.keys;
        const auto smallest =
            std::min_element(keys.begin(), keys.end(),
                             [](const auto& a, const auto& b) { return a.numbers < b.numbers; });
        plan.placement.scale = static_cast<float>(smallest->numbers[0]);
    }
    WEFT_CHECK_OK(project_warp(placement, mode, plan));
    WEFT_CHECK_OK(texture_mapping(plan.placement));
    plan.has_uv = !placement.uv.empty();
    if (plan.has_uv && mode != TemporalMode::kLocked) {
        return fail(ErrorCode::kUsage,
                    "A UV pass needs the locked temporal mode; the other modes synthesize the "
                    "texture in place.",
                    "Set it" + by({{setting::kTemporalMode, "locked"}}) + ".");
    }
    return {};
}

Status project_drawn_form(const Region& region, bool laid, RegionPlan& plan) {
    if (!laid) {
        return fail(ErrorCode::kUsage,
                    "A shape needs the locked temporal mode, and no UV pass beside it, which gives "
                    "the exact place already.",
                    "Set the mode" + by({{setting::kTemporalMode, "locked"}}) +
                        ", or leave the shape out.");
    }
    const bool plane = std::any_of(
        region.form.strokes.begin(), region.form.strokes.end(),
        [](const FormGuide& stroke) { return stroke.kind == FormGuideKind::kParallel; });
    if (region.form.shape.empty() && !plane) {
        return fail(ErrorCode::kUsage, "The form is to come from a shape, but there is none.",
                    "Draw one" + by({{setting::kFormShape}, {setting::kFormStrokes}}) +
                        ", or choose another source" + by({{setting::kFormSource}}) + ".");
    }
    if (!region.form.shape.empty() && plane) {
        return fail(ErrorCode::kUsage, "A shape and parallel strokes both say what the form is.",
                    "Remove the one" + by({{setting::kFormShape}}) + " or the others" +
                        by({{setting::kFormStrokes}}) + ".");
    }
    plan.form_from = RegionPlan::FormFrom::kShape;
    plan.form_fov_deg = region.form.fov_deg;
    plan.form_guides = region.form.shape;
    plan.form_guides.insert(plan.form_guides.end(), region.form.strokes.begin(),
                            region.form.strokes.end());
    for (FormGuide& guide : plan.form_guides)
        guide = unsqueezed(std::move(guide), plan.placement.aspect);
    return {};
}

Status project_form(const Region& region, RegionPlan& plan) {
    const FormFiles pass = form_files(region);
    plan.form_amount = static_cast<float>(region.form.amount);
    plan.form_amount_keys = region.form.amount_keys;
    if (!plan.form_amount_keys.empty()) {
        plan.form_amount = 0;
        for (const NumberKey& key : plan.form_amount_keys.keys)
            plan.form_amount = std::max(plan.form_amount, static_cast<float>(key.numbers[0]));
    }
    if (!(plan.form_amount > 0) || pass.from == RegionPlan::FormFrom::kNothing) return {};
    for (const FormGuide& stroke : region.form.strokes)
        if (stroke.kind == FormGuideKind::kLevel || stroke.kind == FormGuideKind::kCut)
            plan.form_guides.push_back(unsqueezed(stroke, plan.placement.aspect));
    const bool locked = region.temporal.mode == TemporalMode::kLocked;
    if (pass.from == RegionPlan::FormFrom::kMotion) {
        // Corners are the artist's own perspective.
        if (!locked || plan.has_uv || region.placement.corners_px) return {};
        plan.form_from = pass.from;
        plan.form_fov_deg = region.form.fov_deg;
        return {};
    }
    if (pass.from == RegionPlan::FormFrom::kShape)
        return project_drawn_form(region, locked && !plan.has_uv, plan);
    if (pass.from == RegionPlan::FormFrom::kOutline) {
        if (!locked || plan.has_uv) {
            return fail(ErrorCode::kUsage,
                        "An inflated form needs the locked temporal mode, and no UV pass beside "
                        "it, which gives the exact place already.",
                        "Set the mode" + by({{setting::kTemporalMode, "locked"}}) +
                            ", or choose another source" + by({{setting::kFormSource}}) + ".");
        }
        plan.form_from = pass.from;
        plan.form_fov_deg = region.form.fov_deg;
        plan.form_roundness = static_cast<float>(region.form.roundness);
        return {};
    }
    if (pass.pattern.empty()) {
        return fail(ErrorCode::kUsage,
                    "The form is to come from the depth pass, but there is none.",
                    "Give it" + by({{setting::kDepth}}) + ", or choose another source" +
                        by({{setting::kFormSource}}) + ".");
    }
    if (!locked || plan.has_uv) {
        return fail(
            ErrorCode::kUsage,
            pass.what +
                " as form needs the locked temporal mode, and no UV pass beside it, which gives "
                "the exact place already.",
            "Set the mode" + by({{setting::kTemporalMode, "locked"}}) + ", or leave one pass out.");
    }
    plan.form_from = pass.from;
    plan.form_fov_deg = region.form.fov_deg;
    return {};
}

void project_synthesis(const SynthesisParams& synthesis, RegionPlan& plan) {
    plan.seam = synthesis.seam;
    plan.overlap_px = synthesis.overlap_px;
    plan.feather_px = synthesis.feather_px;
    plan.seam_cost = synthesis.seam_cost;
    plan.refine_passes = synthesis.refine;
    plan.orientations = {synthesis.rotations, synthesis.mirror};
    plan.align = synthesis.align;
}

void project_temporal(const TemporalParams& temporal, RegionPlan& plan) {
    plan.temporal = temporal.mode;
    plan.surface = temporal.surface;
    plan.blend = static_cast<float>(temporal.blend);
    plan.weight = static_cast<float>(temporal.weight);
}

Status project_light(const LightParams& light, bool display_referred, RegionPlan& plan) {
    plan.light_source = light.source;
    plan.light = {light.form, static_cast<float>(light.strength)};
    if (!display_referred) plan.light.most_gain = std::numeric_limits<float>::max();
    plan.strength_keys = light.strength_keys;
    plan.lamps = light.lamps;
    if (light.source == LightSource::kPainted && plan.lamps.empty())
        return fail(ErrorCode::kUsage, "Painted light needs lamps.",
                    "Add one" + by({{setting::kLamps}}) + ".");
    plan.detail = static_cast<float>(light.detail);
    plan.keep_detail = static_cast<float>(light.keep_detail);
    plan.cast.reset();
    if (light.cast) plan.cast = static_cast<float>(*light.cast);
    plan.highlights = static_cast<float>(light.highlights);
    plan.highlight_roughness = static_cast<float>(light.roughness);
    plan.light_pass = !light.lighting.empty() ? RegionPlan::Pass::kLighting
                      : !light.albedo.empty() ? RegionPlan::Pass::kAlbedo
                                              : RegionPlan::Pass::kNone;
    // An estimate of no light at all is an error; a pass may be black.
    const bool estimated = display_referred && plan.light_pass == RegionPlan::Pass::kNone;
    plan.light.least_gain = estimated ? kLeastGain : 0;
    plan.exact_light = light.exact;
    if (light.exact && plan.light_pass == RegionPlan::Pass::kNone) {
        return fail(ErrorCode::kUsage, "Exact light needs a pass.",
                    "Give an albedo or a lighting pass" +
                        by({{setting::kAlbedo}, {setting::kLighting}}) + ".");
    }
    return {};
}

std::array<float, 3> rgb_of(const RgbNumbers& numbers) {
    return {static_cast<float>(numbers.r), static_cast<float>(numbers.g),
            static_cast<float>(numbers.b)};
}

void project_grade(const GradeParams& grade, const LayerParams& layer, RegionPlan& plan) {
    plan.match = static_cast<float>(grade.match);
    plan.grade = {.exposure = static_cast<float>(grade.exposure),
                  .temperature = static_cast<float>(grade.temperature),
                  .multiply = rgb_of(grade.multiply),
                  .contrast = static_cast<float>(grade.contrast),
                  .gamma = static_cast<float>(grade.gamma),
                  .saturation = static_cast<float>(grade.saturation),
                  .hue_deg = static_cast<float>(grade.hue_deg),
                  .offset = rgb_of(grade.offset)};
    plan.opacity = static_cast<float>(layer.opacity);
    plan.blend_mode = layer.blend;
}

void project_finish(const FinishParams& finish, FlowQuality quality, RegionPlan& plan) {
    plan.grain = static_cast<float>(finish.grain);
    plan.focus = static_cast<float>(finish.focus);
    plan.has_depth = plan.focus > 0 && !finish.depth.empty();
    plan.shutter_deg = 0.0f;
    if (quality != FlowQuality::kFinal) return;
    plan.shutter_deg.reset();
    if (finish.shutter_deg) plan.shutter_deg = static_cast<float>(*finish.shutter_deg);
}

void project_lines(const LineParams& lines, RegionPlan& plan) {
    plan.has_lines = !lines.files.empty();
    plan.extract_lines = lines.extract && !plan.has_lines;
    plan.line_width_px = static_cast<float>(lines.width_px);
}

}  // namespace weft

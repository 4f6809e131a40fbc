#include "tests/project/sample_project.h"

namespace weft::test {
namespace {

Region full_region() {
    Region r;
    r.id = 7;
    r.name = "Wall „left“";
    r.enabled = false;
    r.color = 3;
    MatteSource matte;
    matte.keyframes = {
        {-5, {"mattes/a.png", {}}}, {12, {"mattes/b.png", {}}}, {100, {"mattes/c.png", {}}}};
    matte.confirmed = {{30, {"mattes/d.png", "mattes/d_area.png"}}};
    matte.select = {4, "R", true, "Wall,Door"};
    matte.steadiness = 0.75;
    matte.frozen = {10, 11};
    matte.frozen_files = "final/####.png";
    matte.propagate_direction = PropagationDirection::kBackward;
    matte.propagate_from = -5;
    matte.propagate_to = 100;
    matte.edge = {.min_island_px = 40,
                  .min_hole_px = 30,
                  .smooth_px = 1.5,
                  .choke_px = -0.3,
                  .feather_px = 4,
                  .blur_px = 0.7,
                  .choke_keys = {{{1, {0}}, {24, {3}}}},
                  .feather_keys = {{{1, {-2}}}},
                  .blur_keys = {{{1, {0.5}}}}};
    r.matte = matte;
    MatteSource holdout;
    holdout.files = "hold/####.png";
    MatteSource painted;
    painted.keyframes = {{12, {"mattes/hand.png", {}}}};
    painted.propagate_direction = PropagationDirection::kForward;
    painted.edge.choke_px = 2;
    r.holdouts = std::vector<MatteSource>{holdout, painted};
    Zone zone;
    zone.value = 0.25;
    zone.value_keys = {{{1, {0}}, {24, {2}}}};
    zone.matte = painted;
    Zone zone_in_files;
    zone_in_files.matte = holdout;
    r.zones = std::vector<Zone>{zone, zone_in_files};
    r.texture = {"brick.jpg",
                 {"brick2.jpg", "brick3.jpg"},
                 PlaneMode::kStretch,
                 "plane.exr",
                 WrapMode::kMirror,
                 "linear",
                 {}};
    r.placement.scale = 0.1;
    r.placement.rotate_deg = -12.5;
    r.placement.offset_px = {3, -4.25};
    r.placement.corners_px = {{{0, 0}, {100, 1}, {99, 50}, {-1, 51}}};
    r.placement.fit = false;
    r.placement.scale_keys = {{{1, {1}, KeyInterpolation::kSmooth}, {24, {1.5}}}};
    r.placement.rotate_keys = {{{1, {0}}, {24, {90}}}};
    r.placement.offset_keys = {{{1, {0, 0}, KeyInterpolation::kHold}, {24, {10, 5}}}};
    r.reference_frames = {12, 40};
    r.corrections[20] = {{{10, 20.5}, {12, 20}}, {{100, 90}, {100, 90}}};
    r.amendments = std::vector<PlaneAmendment>{
        {PlaneAmendment::Kind::kKeep, 0, {{10, 20, 30, 1, 2, 0, 0}, {10, 21, 1, 3, 4, 2, 5}}},
        {PlaneAmendment::Kind::kAgain, 4000000000u, {{-3, 7, 12, 0, 0, 0, 0}}}};
    r.form.position = "position/####.exr";
    r.form.position_layer = "shot.Position";
    r.form.normal = "normal/####.exr";
    r.form.normal_layer = "shot.Normal";
    r.form.normal_space = NormalSpace::kWorld;
    r.form.source = FormSource::kShape;
    r.form.depth_kind = DepthKind::kRay;
    r.form.fov_deg = 47.5;
    r.form.roundness = 1.5;
    r.form.amount = 0.75;
    r.form.amount_keys = {{{1, {0}, KeyInterpolation::kSmooth}, {24, {1}}}};
    r.form.shape = {{FormGuideKind::kCylinder, {100, 40, 104, 300, 50, 52.5, -10}}};
    r.form.strokes = {{FormGuideKind::kLevel, {80, 100, 130, 104}}};
    r.placement.warp = grid_over(
        {glm::dvec2(10, 20), glm::dvec2(300, 25), glm::dvec2(290, 220.5), glm::dvec2(0, 200)}, 2,
        1);
    r.placement.warp->falloff_px = 40.25;
    r.placement.warp->points[1].at.y += 6;
    r.placement.warp->points[1].right = glm::dvec2(44, 3.5);
    set_key(*r.placement.warp, 7, r.placement.warp->points);
    r.placement.uv = "uv/####.exr";
    r.placement.uv_layer = "shot.UV";
    r.motion = {"flow/####.flo",
                MotionDirection::kBackward,
                MotionConvention::kNuke,
                "vectors",
                "pins.nk",
                {}};
    r.synthesis = {
        SeamMethod::kDynamicProgramming, 24, 3, SeamCost::kPaper, 5, true, true, false, {}};
    r.temporal = {TemporalMode::kPaper, 0.35, 2.5, SurfaceKind::kPlane, {}};
    r.light.source = LightSource::kImage;
    r.light.image = "light.png";
    r.light.form = LightForm::kDetail;
    r.light.strength = 0.75;
    r.light.strength_keys = {{{1, {1}}, {24, {0.3}}}};
    r.light.lamps = {{LampKind::kPoint, {{{0, {320, 180, 200, 1.5}}}}},
                     {LampKind::kGradient, {{{1, {0, 0, 0, 9, 1, 2}}, {11, {0, 0, 0, 9, 1, 4}}}}}};
    r.light.cast = 0.25;
    r.light.detail = 0.8;
    r.light.keep_detail = 0.4;
    r.light.highlights = 0.5;
    r.light.roughness = 0.25;
    r.light.albedo = "albedo/####.exr";
    r.light.lighting = "lighting/####.exr";
    r.light.pass_layer = "shot.DiffCol";
    r.light.exact = true;
    r.grade = {0.5, -1, 20, {1, 0.9, 0.8}, {0.01, 0, -0.02}, 1.2, 0.9, 0.7, 15, {}};
    r.layer = {0.8, BlendMode::kSoftLight, {}};
    r.finish = {0.5, 0.25, "depth/####.exr", "shot.Depth", 172.8, {}};
    r.lines = {"lines/####.png", true, true, 2.5, {}};
    return r;
}

}  // namespace

Project full_project() {
    Project p;
    p.name = "Shot 010";
    p.plate = {"frames/####.exr", "beauty", 1, "ACEScg", 23.976, 1.8, MissingFrames::kHold, {}};
    p.color = {"linear", "srgb", "linear", {}};
    p.settings = {Quality::kDraft, 9007199254740991, "1-40", "GPL, CC-BY-NC", {}};
    p.output = {"out/####.exr",
                OutputDepth::kHalf,
                80,
                "piz",
                "review.mp4",
                true,
                {LayerKind::kPatch, LayerKind::kSt},
                "layers/####.exr",
                {}};
    p.regions.emplace_back(full_region());
    Region second;
    second.id = 2;
    second.name = "Floor";
    p.regions.emplace_back(second);
    p.next_region_id = 9;
    return p;
}

std::string json_with_unknown_keys() {
    return R"({
  "schema": "weft.project/6",
  "future_top": {"deep": [1, {"x": null}], "big": 1e300},
  "plate": {"path": "frames/####.png", "future_plate": "p"},
  "color": {"future_color": 0.1},
  "settings": {"future_settings": true},
  "output": {"future_output": []},
  "regions": [{
    "id": 1, "future_region": "ä",
    "matte": {"keyframes": [{"frame": 12, "path": "a.png", "future_key": 1}], "future_matte": 2},
    "holdouts": [{"files": "h/####.png", "future_holdout": 3}],
    "zones": [{"value": 0.5, "matte": {"files": "z.png"}, "future_zone": 10}],
    "texture": {"sample": "s.png", "future_texture": 4},
    "placement": {"future_placement": 5},
    "motion": {"future_motion": 6},
    "synthesis": {"future_synthesis": 7},
    "temporal": {"future_temporal": 8},
    "light": {"future_light": 9}
  }]
})";
}

}  // namespace weft::test

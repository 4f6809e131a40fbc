#pragma once
// What the pipeline needs of one region: plain settings, with all paths and names resolved.

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/color/color_space.h"
#include "engine/color/grade.h"
#include "engine/composite/blend_mode.h"
#include "engine/compute/backend.h"
#include "engine/core/frame_range.h"
#include "engine/core/grid_warp.h"
#include "engine/core/image.h"
#include "engine/core/keyed_numbers.h"
#include "engine/form/form_guide.h"
#include "engine/lighting/lamp.h"
#include "engine/lighting/light_source.h"
#include "engine/lighting/plate_detail.h"
#include "engine/lighting/plate_exposure.h"
#include "engine/lighting/shading.h"
#include "engine/mask/matte_edge.h"
#include "engine/mask/matte_reach.h"
#include "engine/motion/corner_track.h"
#include "engine/motion/optical_flow.h"
#include "engine/pipeline/stage_store.h"
#include "engine/pipeline/zone_kind.h"
#include "engine/seam/seam.h"
#include "engine/seam/seam_cost.h"
#include "engine/synthesis/plane_amendment.h"
#include "engine/synthesis/plane_mode.h"
#include "engine/synthesis/sample_atlas.h"
#include "engine/temporal/correction.h"
#include "engine/temporal/placement.h"
#include "engine/temporal/surface_kind.h"
#include "engine/temporal/temporal_mode.h"

namespace weft {

class WalkMemory;

/// A texture as it was read: exactly one of `sample` (to be grown) and `plane` (used as it is).
struct TexturePicture {
    ImageF3 pixels;             ///< In the texture's own space.
    std::vector<ImageF3> also;  ///< More samples of the same material, in the same space.
    bool is_plane = false;
    /// Beyond the border of a given plane; grown planes repeat.
    WrapMode wrap = WrapMode::kRepeat;
};

/// A matte painted on a few frames and propagated to the others.
struct PaintedMatte {
    std::vector<int> keys;  ///< Ascending.
    float steadiness = 0.5f;
    MatteReach reach;
    MatteEdgePlan edge = {};  ///< For the composite; what is propagated is the matte without it.
    /// Frames on which parts of the propagated matte are confirmed, ascending, none of them a key.
    std::vector<int> confirmed = {};
};

/// A part of a region in which a setting has another value.
struct ZonePlan {
    ZoneKind kind = ZoneKind::kLight;
    PaintedMatte painted;  ///< Without keys the zone's matte comes from files.
    float value = 1;
    KeyedNumbers value_keys;  ///< Over time, instead of `value`.
    MatteEdgePlan edge;
    [[nodiscard]] bool propagated() const { return !painted.keys.empty(); }
    [[nodiscard]] float value_at(int frame) const {
        return value_keys.empty() ? value : value_keys.float_at(frame)[0];
    }
};

struct RegionPlan {
    std::uint64_t random_key = 0;  ///< Stable id of the region; enters the keys of random numbers.
    // Mattes: frame by frame, or painted on these frames (ascending) and propagated.
    std::vector<int> matte_keys;
    std::vector<int> matte_confirmed;  ///< As PaintedMatte::confirmed.
    [[nodiscard]] bool propagated() const { return !matte_keys.empty(); }
    float matte_steadiness = 0.5f;  ///< Of propagated mattes, 0–1.
    MatteReach matte_reach;
    bool has_holdout = false;  ///< Holdouts from files.
    /// Edge tools of the matte and of each holdout from files, for the composite. The analysis
    /// follows the mattes without them.
    MatteEdgePlan matte_edge;
    std::vector<MatteEdgePlan> given_holdout_edges;
    std::vector<PaintedMatte> painted_holdouts;
    std::vector<ZonePlan> zones;
    // Motion and placement.
    std::vector<int> reference_frames;  ///< The first holds the placement; at least one.
    std::map<int, std::vector<SurfacePin>> corrections;  ///< All on reference frames.
    /// The run of frames with all files around the reference frame, over which motion is calmed;
    /// empty without zones that calm it.
    FrameRange calm_span;
    bool true_motion = false;
    /// True-motion files point to the next frame; false: to the previous one.
    bool motion_forward = true;
    CornerTrack track;         ///< The track of the plane that the surface follows; empty: none.
    PlanePlacement placement;  ///< With keyed scales the smallest, for which the plane is grown.
    /// Over time, in place of the values in `placement`.
    KeyedNumbers scale_keys, rotate_keys, offset_keys;
    /// The grid of placement.warp: with keys over time that of their first frame is there.
    std::optional<GridWarp> warp;
    [[nodiscard]] bool placement_moves() const {
        return !scale_keys.empty() || !rotate_keys.empty() || !offset_keys.empty() ||
               (warp && warp->moves());
    }
    /// The placement on a frame, relative to the reference frame.
    [[nodiscard]] PlanePlacement placement_at(int frame) const {
        PlanePlacement out = placement;
        if (!scale_keys.empty()) out.scale = scale_keys.float_at(frame)[0];
        if (!rotate_keys.empty()) out.rotate_deg = rotate_keys.float_at(frame)[0];
        if (!offset_keys.empty())
            out.offset_px = {offset_keys.float_at(frame)[0], offset_keys.float_at(frame)[1]};
        if (warp && warp->moves()) out.warp = std::make_shared<const PlaneWarp>(*warp, frame);
        return out;
    }
    // Texture.
    std::shared_ptr<const TexturePicture> texture;
    std::shared_ptr<const ColorTransform> working_from_texture, display_from_texture,
        working_from_display;
    SeamMethod seam = SeamMethod::kGraphCut;
    int overlap_px = 36;
    int feather_px = 0;
    SeamCost seam_cost = SeamCost::kGradient;
    int refine_passes = 2;
    Orientations orientations;
    bool align = true;
    PlaneMode mode = PlaneMode::kSynthesize;  ///< Of planes for the whole shot.
    std::vector<PlaneAmendment> amendments;   ///< Of the grown plane.
    // Time.
    TemporalMode temporal = TemporalMode::kLocked;
    SurfaceKind surface = SurfaceKind::kFound;  ///< Where motion is estimated.
    float blend = 0.2f;                         ///< α of the paper mode.
    float weight = 1.0f;                        ///< λ_t of the paper mode.
    // Light.
    LightSource light_source = LightSource::kPlate;
    std::shared_ptr<const ImageF3> light_picture;  ///< Linear light; for kImage.
    LightOptions light;
    KeyedNumbers strength_keys;       ///< λ over time, instead of light.strength.
    std::vector<Lamp> lamps;          ///< For kPainted.
    float detail = kEstimatedDetail;  ///< Light detail, 0–1.
    float keep_detail = 0;            ///< How much of the old surface's fine detail stays, 0–2.
    /// How much of the light's colour the texture takes, 0–1; empty: as far as there is evidence.
    std::optional<float> cast = 0.0f;
    [[nodiscard]] bool tints() const { return !cast || *cast > 0; }
    float highlights = 0;           ///< How much of the old surface's gloss stays, 0–2.
    float highlight_roughness = 0;  ///< 0–1, see HighlightOptions.
    enum class Pass { kNone, kAlbedo, kLighting };
    Pass light_pass = Pass::kNone;  ///< A pass of the artist that gives the plate's light.
    /// Uses that light as it is, not relative to the reference frame's.
    bool exact_light = false;
    /// A UV pass gives the place of the plane that each pixel shows.
    bool has_uv = false;
    /// What shows the surface's form: places (a position pass, or depth with the camera), normals,
    /// the motion of the surface, what the artist drew, or the outline.
    enum class FormFrom : std::uint8_t {
        kNothing,
        kPositions,
        kNormals,
        kMotion,
        kShape,
        kOutline
    };
    FormFrom form_from = FormFrom::kNothing;
    float form_amount = 1;          ///< 0 flat, 1 as found; with keys the largest of them.
    KeyedNumbers form_amount_keys;  ///< Over time.
    [[nodiscard]] float form_amount_at(int frame) const {
        return form_amount_keys.empty() ? form_amount : form_amount_keys.float_at(frame)[0];
    }
    float form_roundness = 1;  ///< Of kOutline: 0 flat, 2 as thick as wide.
    /// Horizontal field of view; empty: found as well, or in the pass's header.
    std::optional<double> form_fov_deg;
    /// Shapes and strokes on the reference frame, unsqueezed; level strokes turn every form.
    std::vector<FormGuide> form_guides;
    /// Frames that show the form, the reference frame first; they do not depend on the part of the
    /// shot that is rendered.
    std::vector<int> form_evidence;
    [[nodiscard]] bool has_form() const {
        return form_from != FormFrom::kNothing && form_amount > 0 && !form_evidence.empty();
    }
    /// Whether its motion says something of the shot's lens: its form comes from it, and no field
    /// of view is given.
    [[nodiscard]] bool shares_lens() const {
        return form_from == FormFrom::kMotion && has_form() && !form_fov_deg;
    }
    /// λ on a frame.
    [[nodiscard]] float strength_at(int frame) const {
        return strength_keys.empty() ? light.strength : strength_keys.float_at(frame)[0];
    }
    [[nodiscard]] bool lights() const {
        return light_source != LightSource::kNone &&
               (light.strength > 0 || !strength_keys.empty() || tints() || highlights > 0);
    }
    /// Whether the plate's shading has to be estimated.
    [[nodiscard]] bool estimates_light() const {
        return light_source == LightSource::kPlate && lights() && light_pass == Pass::kNone &&
               !is_transfer(light.form);
    }
    /// The frame that the light and the exposure are relative to, if that is not the reference
    /// frame, because that shows nothing.
    std::optional<int> light_frame;
    [[nodiscard]] int light_reference() const {
        return light_frame.value_or(reference_frames.front());
    }
    /// Frames that show what is old texture and what is light, ascending; empty: each frame is
    /// estimated alone. They do not depend on the part of the shot that is rendered.
    std::vector<int> light_evidence;
    /// Frames that show what moves over the surface, ascending; empty: highlights are told apart by
    /// their colour alone. They do not depend on the part of the shot that is rendered.
    std::vector<int> gloss_evidence;
    // Colour, and the way over the old surface.
    float match = 0;  ///< How far the exposure follows the plate's, 0–1.
    Grade grade;
    [[nodiscard]] bool grades() const { return match > 0 || grade != Grade{}; }
    float opacity = 1;
    BlendMode blend_mode = BlendMode::kNormal;
    [[nodiscard]] bool blends() const { return opacity < 1 || blend_mode != BlendMode::kNormal; }
    // Finish: effects of the plate's camera.
    float grain = 0, focus = 0;     ///< Strengths; 0: none.
    bool has_depth = false;         ///< Defocus follows a depth pass.
    std::vector<int> grain_frames;  ///< Grain is measured on these, from the reference on.
    /// The frames of the plate on which its focus can be read, ascending, wherever they lie.
    std::vector<int> focus_frames;
    /// Shutter angle in degrees of 360 per frame; the texture is blurred along its motion. Empty:
    /// the plate's own, measured on the frames `shutter_evidence`.
    std::optional<float> shutter_deg = 0.0f;
    /// Consecutive frames that begin with the reference frame.
    std::vector<int> shutter_evidence;
    [[nodiscard]] bool estimates_shutter() const {
        return !shutter_deg && !shutter_evidence.empty();
    }
    // Ink on top: from a pass, or extracted from the plate.
    bool has_lines = false, extract_lines = false;
    float line_width_px = 4;
};

/// Settings of the whole shot.
struct ShotPlan {
    std::vector<int> frames;                    ///< To be rendered, ascending.
    FlowQuality quality = FlowQuality::kFinal;  ///< Of light, gloss and sampling.
    /// Of mattes and tracks; draft only for what is provisional. So a draft and its final share the
    /// propagated mattes.
    FlowQuality motion_quality = FlowQuality::kFinal;
    std::uint64_t seed = 1;
    bool display_referred = true;  ///< The output rolls off above 1.
    std::shared_ptr<const ColorTransform> working_from_plate, display_from_plate, out_from_working,
        out_from_plate, display_from_working;
    ExposureGreys exposure_greys;  ///< In the working space.
    bool layers = false;           ///< Frames are rendered with their FrameLayers.
    bool form_layers = false;      ///< And with those of the form (shows_form()).
    bool keep_planes = false;      ///< Scenes keep what their planes were made of.
    bool spare_memory = false;     ///< Frames are not prepared side by side.
    /// The step of the plate's codes, as a share of white; 0: floating point.
    float plate_quantum = 0;
    std::vector<RegionPlan> regions;     ///< Lowest layer first.
    std::shared_ptr<StageStore> stages;  ///< Stored planes and motion; may be null.
    std::shared_ptr<WalkMemory> walks;   ///< Earlier ones; may be null.
    bool keep_walks = false;             ///< Adds these to them.
};

[[nodiscard]] inline const RegionPlan& region_of(const ShotPlan& plan, int region) {
    return plan.regions[static_cast<std::size_t>(region)];
}

}  // namespace weft

#pragma once
// What the pipeline needs to know of one region: plain settings, all paths and names resolved.

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/color/color_space.h"
#include "engine/compute/backend.h"
#include "engine/core/image.h"
#include "engine/core/keyed_numbers.h"
#include "engine/lighting/lamp.h"
#include "engine/lighting/light_source.h"
#include "engine/lighting/shading.h"
#include "engine/mask/matte_reach.h"
#include "engine/motion/corner_track.h"
#include "engine/motion/optical_flow.h"
#include "engine/pipeline/stage_store.h"
#include "engine/pipeline/zone_kind.h"
#include "engine/seam/seam.h"
#include "engine/seam/seam_cost.h"
#include "engine/synthesis/plane_amendment.h"
#include "engine/synthesis/sample_atlas.h"
#include "engine/temporal/correction.h"
#include "engine/temporal/placement.h"
#include "engine/temporal/temporal_mode.h"

namespace weft {

/// A texture as it was read: exactly one of `sample` (to be grown) and `plane` (used as it is).
struct TexturePicture {
    ImageF3 pixels;             ///< In the texture's own space.
    std::vector<ImageF3> also;  ///< Further samples of the same material, in the same space.
    bool is_plane = false;
    WrapMode wrap = WrapMode::kRepeat;  ///< Beyond a given plane; grown planes repeat.
};

/// A matte painted on a few frames and propagated to the others.
struct PaintedMatte {
    std::vector<int> keys;  ///< Ascending.
    float steadiness = 0.5f;
    MatteReach reach;
};

/// A part of a region in which a setting has another value.
struct ZonePlan {
    ZoneKind kind = ZoneKind::kLight;
    PaintedMatte painted;  ///< Without keys the zone's matte comes from files.
    float value = 1;
    KeyedNumbers value_keys;  ///< Over time, instead of `value`.
    [[nodiscard]] bool propagated() const { return !painted.keys.empty(); }
    [[nodiscard]] float value_at(int frame) const {
        return value_keys.empty() ? value : value_keys.float_at(frame)[0];
    }
};

struct RegionPlan {
    std::uint64_t random_key = 0;  ///< Stable id of the region; enters the keys of random numbers.
    // Mattes: frame by frame, or painted on these frames (ascending) and propagated.
    std::vector<int> matte_keys;
    [[nodiscard]] bool propagated() const { return !matte_keys.empty(); }
    float matte_steadiness = 0.5f;  ///< Of propagated mattes, 0–1.
    MatteReach matte_reach;
    bool has_holdout = false;  ///< In files.
    std::vector<PaintedMatte> painted_holdouts;
    std::vector<ZonePlan> zones;
    // Motion and placement.
    std::vector<int> reference_frames;  ///< The first holds the placement; at least one.
    std::map<int, std::vector<SurfacePin>> corrections;  ///< All on reference frames.
    bool true_motion = false;
    bool motion_forward = true;  ///< A file of true motion points to the next frame, else back.
    CornerTrack track;           ///< Of the plane that the surface follows; empty: none.
    PlanePlacement placement;    ///< Of keyed scales the smallest, for which the plane is grown.
    KeyedNumbers scale_keys, rotate_keys, offset_keys;  ///< Over time, instead of placement's own.
    [[nodiscard]] bool placement_moves() const {
        return !scale_keys.empty() || !rotate_keys.empty() || !offset_keys.empty();
    }
    /// The placement as it is on a frame, always with respect to the reference frame.
    [[nodiscard]] PlanePlacement placement_at(int frame) const {
        PlanePlacement out = placement;
        if (!scale_keys.empty()) out.scale = scale_keys.float_at(frame)[0];
        if (!rotate_keys.empty()) out.rotate_deg = rotate_keys.float_at(frame)[0];
        if (!offset_keys.empty())
            out.offset_px = {offset_keys.float_at(frame)[0], offset_keys.float_at(frame)[1]};
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
    std::vector<PlaneAmendment> amendments;  ///< Of the grown plane.
    // Time.
    TemporalMode temporal = TemporalMode::kLocked;
    float blend = 0.2f;   ///< α of the paper mode.
    float weight = 1.0f;  ///< λ_t of the paper mode.
    // Light.
    LightSource light_source = LightSource::kPlate;
    std::shared_ptr<const ImageF3> light_picture;  ///< Linear light; for kImage.
    LightOptions light;
    KeyedNumbers strength_keys;  ///< λ over time, instead of light.strength.
    std::vector<Lamp> lamps;     ///< For kPainted.
    float cast = 0;              ///< How far the light's colour is taken over, 0–1.
    float highlights = 0;        ///< How much of the old surface's gloss is kept.
    enum class Pass { kNone, kAlbedo, kLighting };
    Pass light_pass = Pass::kNone;  ///< A pass of the artist's that gives the plate's light.
    bool exact_light = false;       ///< That light as it is, not relative to the reference frame's.
    bool has_uv = false;            ///< A UV pass says which place of the plane each pixel shows.
    /// λ on a frame.
    [[nodiscard]] float strength_at(int frame) const {
        return strength_keys.empty() ? light.strength : strength_keys.float_at(frame)[0];
    }
    [[nodiscard]] bool lights() const {
        return light_source != LightSource::kNone &&
               (light.strength > 0 || !strength_keys.empty() || cast > 0 || highlights > 0);
    }
    /// Whether the plate's shading has to be estimated.
    [[nodiscard]] bool estimates_light() const {
        return light_source == LightSource::kPlate && lights() && light_pass == Pass::kNone &&
               !is_transfer(light.form);
    }
    /// Frames whose evidence tells the old texture from light, ascending; empty: each frame stands
    /// for itself. They do not depend on what part of a shot is rendered.
    std::vector<int> light_evidence;
    // Finish: what the plate's camera does to a picture.
    float grain = 0, focus = 0;     ///< Strengths; 0: none.
    bool has_depth = false;         ///< Focus follows a depth pass.
    std::vector<int> grain_frames;  ///< Grain is measured on these, from the reference on.
    /// How long the shutter is open, in degrees of 360 a frame: the texture is blurred along its
    /// motion. Without a number it is the plate's own, measured on the frames `shutter_evidence`.
    std::optional<float> shutter_deg = 0.0f;
    std::vector<int> shutter_evidence;  ///< A run of frames with the reference at its beginning.
    [[nodiscard]] bool estimates_shutter() const {
        return !shutter_deg && !shutter_evidence.empty();
    }
    // Ink on top: from a pass, or found in the plate.
    bool has_lines = false, extract_lines = false;
    float line_width_px = 4;
};

/// What holds for the whole shot.
struct ShotPlan {
    std::vector<int> frames;  ///< To be rendered, ascending.
    FlowQuality quality = FlowQuality::kFinal;
    std::uint64_t seed = 1;
    bool display_referred = true;  ///< The output rolls off above 1.
    std::shared_ptr<const ColorTransform> working_from_plate, display_from_plate, out_from_working,
        out_from_plate, display_from_working;
    bool layers = false;              ///< Frames are rendered with their FrameLayers.
    bool keep_planes = false;         ///< Scenes keep what their planes were made of.
    float plate_quantum = 0;          ///< The step of the plate's codes, of 1; 0: floating point.
    std::vector<RegionPlan> regions;  ///< Lowest layer first.
    std::shared_ptr<StageStore> stages;  ///< Planes and motion made before; may be null.
};

}  // namespace weft

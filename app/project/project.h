#pragma once
// The document: an immutable value used for editing, undo, jobs, the command line and the editor.
// Only an Edit (edit.h) changes it. parameters.h describes every number and choice once;
// docs/FORMATS.md describes the file.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/project/leaf.h"
#include "app/project/matte_source.h"
#include "engine/composite/blend_mode.h"
#include "engine/compute/wrap_mode.h"
#include "engine/core/error.h"
#include "engine/core/fields.h"
#include "engine/core/grid_warp.h"
#include "engine/core/keyed_numbers.h"
#include "engine/form/depth_positions.h"
#include "engine/form/form_guide.h"
#include "engine/lighting/lamp.h"
#include "engine/lighting/light_source.h"
#include "engine/lighting/shading.h"
#include "engine/pipeline/layer_kind.h"
#include "engine/pipeline/zone_kind.h"
#include "engine/seam/seam.h"
#include "engine/seam/seam_cost.h"
#include "engine/synthesis/plane_amendment.h"
#include "engine/synthesis/plane_mode.h"
#include "engine/temporal/surface_kind.h"
#include "engine/temporal/temporal_mode.h"

namespace weft {

/// A point on the plate in full-resolution pixels, origin top-left, y down.
struct PlatePoint {
    double x = 0, y = 0;
    bool operator==(const PlatePoint&) const = default;
};

/// A number for each channel.
struct RgbNumbers {
    double r = 0, g = 0, b = 0;
    bool operator==(const RgbNumbers&) const = default;
};

/// Stable id of a region inside its project, from 1; never reused. It keys random numbers and
/// cached analysis, so it must survive renaming and reordering.
using RegionId = std::uint32_t;

/// What replaces a frame that is missing in the plate.
enum class MissingFrames {
    kError,
    kHold,   ///< The previous frame.
    kBlack,  ///< A black frame.
    kSkip    ///< The frame is not rendered.
};

/// The sequence whose surfaces get new textures.
struct Plate {
    std::string path;        ///< Pattern ("frames/####.png"), folder or movie.
    std::string layer;       ///< EXR layer; empty: the file's R, G, B.
    int movie_start = 1001;  ///< Number of a movie's first frame.
    std::string space;       ///< Colour space; empty: auto, from the file type.
    double fps = 0;          ///< 0: from the files, otherwise 24.
    /// Width of a pixel over its height; unset: from the files, otherwise 1.
    std::optional<double> pixel_aspect;
    MissingFrames missing = MissingFrames::kError;
    Extras extra;
    bool operator==(const Plate&) const = default;
};

/// Colour spaces of the shot; empty: auto from the file type (textures, output), or linear
/// (working).
struct ColorSettings {
    std::string working_space, texture_space, out_space;
    Extras extra;
    bool operator==(const ColorSettings&) const = default;
};

enum class Quality { kDraft, kFinal };

struct RenderSettings {
    Quality quality = Quality::kFinal;
    std::int64_t seed = 1;
    std::string frames;  ///< "1-40", "1-100x2", "1,4,9-12"; empty: every frame of the plate.
    /// Licences and licence families that textures of this project must not have, separated by
    /// commas.
    std::string excluded_licences;
    Extras extra;
    bool operator==(const RenderSettings&) const = default;
};

enum class OutputDepth { kAuto, k8, k16, kHalf, kFloat };

/// Output files.
struct Output {
    std::string path;  ///< Pattern of the numbered images.
    OutputDepth depth =
        OutputDepth::kAuto;  ///< kAuto: the plate's depth, or the nearest that the format supports.
    int jpeg_quality = 95;
    std::string exr_compression = "auto";
    std::string movie;              ///< Review movie (.mp4, .mkv); empty: none.
    bool burn_in = false;           ///< Burns frame, version and colour space into the movie.
    std::vector<LayerKind> layers;  ///< Layers for compositing, without duplicates.
    /// Pattern of separate EXR files for the layers; empty: in the output.
    std::string layers_path;
    Extras extra;
    bool operator==(const Output&) const = default;
};

/// A part of a region in which a setting has another value: a matte like the region's own, painted
/// or from files, and the value inside it. Several zones on the light's strength multiply; of those
/// on light detail the last one counts.
struct Zone {
    ZoneKind kind = ZoneKind::kLight;
    double value = 0;
    KeyedNumbers value_keys;  ///< The value over time; empty: `value` throughout.
    MatteSource matte;
    Extras extra;
    bool operator==(const Zone&) const = default;
};

/// Returns true if a texture is named by its library id ("db:ID") instead of a file.
[[nodiscard]] inline bool names_library_texture(std::string_view path) {
    return path.starts_with("db:");
}

/// The texture of a surface: a sample to synthesize from, or a plane used as it is. Each is a file
/// or a library texture.
struct TextureSource {
    std::string sample;
    std::vector<std::string> also;      ///< Further samples of the same material.
    PlaneMode mode = PlaneMode::kAuto;  ///< How the sample covers the surface.
    std::string plane;                  ///< Image used without synthesis.
    WrapMode wrap = WrapMode::kRepeat;  ///< Continuation beyond the border of `plane`.
    std::string space;                  ///< Colour space; empty: the project's texture space.
    Extras extra;
    bool operator==(const TextureSource&) const = default;
};

/// Placement of the texture on the plate's reference frame.
struct Placement {
    double scale = 1;       ///< Plate pixels per sample pixel at the placement's origin.
    double rotate_deg = 0;  ///< Counter-clockwise on screen.
    PlatePoint offset_px;
    /// Corner pin (TL, TR, BR, BL): a perspective placement; scale, rotation and offset apply
    /// inside it.
    std::optional<std::array<PlatePoint, 4>> corners_px;
    /// Fits a plane's image into the corners; otherwise `scale` applies there too.
    bool fit = true;
    /// Animated values that replace those above; an offset has two numbers, x and y.
    KeyedNumbers scale_keys, rotate_keys, offset_keys;
    std::optional<GridWarp> warp;  ///< On the reference frame, on top of the surface's form.
    std::string uv;        ///< Pattern of a UV pass or ST-map with exact texture coordinates.
    std::string uv_layer;  ///< Empty: found.
    Extras extra;
    bool operator==(const Placement&) const = default;
};

/// What shows the shape of a surface.
enum class FormSource {
    kAuto,   ///< The pass if there is one, else what is drawn, else the motion, as far as it tells.
    kPass,   ///< The position pass, without one the normal pass; flat without both.
    kDepth,  ///< The depth pass (FinishParams::depth), with the camera's field of view.
    kShape,  ///< What the artist drew: FormParams::shape, else the parallel ones of the strokes.
    kInflate,  ///< The outline, taken to be where the surface turns away.
    kFlat
};
/// The axes of a normal pass.
enum class NormalSpace {
    kAuto,  ///< As the file tells; the camera's where it does not.
    kCamera,
    kWorld  ///< The file's header tells how the camera is turned, or a position pass beside.
};

/// The shape of the surface, which the texture follows.
struct FormParams {
    FormSource source = FormSource::kAuto;
    std::string position;        ///< Pattern of a position pass.
    std::string position_layer;  ///< Empty: found.
    std::string normal;          ///< Pattern of a normal pass.
    std::string normal_layer;    ///< Empty: found.
    NormalSpace normal_space = NormalSpace::kAuto;
    DepthKind depth_kind = DepthKind::kZ;
    std::optional<double> fov_deg;   ///< Horizontal; unset: from the header of the pass, or found.
    std::vector<FormGuide> shape;    ///< At most one, over the surface on the reference frame.
    std::vector<FormGuide> strokes;  ///< Along it.
    double roundness = 1;            ///< Of kInflate: 0 flat, 2 as thick as wide.
    double amount = 1;               ///< 0 flat, 1 as found.
    KeyedNumbers amount_keys;        ///< The amount over time; empty: `amount` throughout.
    Extras extra;
    bool operator==(const FormParams&) const = default;
};

/// The source of the surface's motion.
struct MotionSource {
    std::string files;  ///< Pattern of true motion; empty: estimated from the plate.
    MotionDirection direction = MotionDirection::kForward;
    MotionConvention convention = MotionConvention::kFiles;
    std::string layer;  ///< EXR layer of the motion pass; empty: found automatically.
    std::string track;  ///< File of a planar track, used instead of estimated motion.
    Extras extra;
    bool operator==(const MotionSource&) const = default;
};

struct SynthesisParams {
    SeamMethod seam = SeamMethod::kGraphCut;
    int overlap_px = 36;
    int feather_px = 0;
    SeamCost seam_cost = SeamCost::kGradient;
    int refine = 2;  ///< Refinement rounds; default as kDefaultRefinePasses.
    bool rotations = false, mirror = false;
    bool align = true;
    Extras extra;
    bool operator==(const SynthesisParams&) const = default;
};

struct TemporalParams {
    TemporalMode mode = TemporalMode::kLocked;
    double blend = 0.2;  ///< The paper's α (eq. 6).
    double weight = 1;   ///< The paper's λ_t (eq. 5).
    SurfaceKind surface = SurfaceKind::kFound;
    Extras extra;
    bool operator==(const TemporalParams&) const = default;
};

struct LightParams {
    LightSource source = LightSource::kPlate;
    std::string image;  ///< Illumination image for kImage.
    LightForm form = LightForm::kGain;
    double strength = 1;         ///< λ, 0–2; above 1 the light's contrast is raised.
    KeyedNumbers strength_keys;  ///< λ over time; empty: `strength` throughout.
    std::vector<Lamp> lamps;     ///< Painted light, for kPainted.
    /// Light detail: 0 is broad light only, 0.5 the light as estimated, 1 all that the plate shows.
    double detail = 0.5;
    double keep_detail = 0;  ///< Keep plate detail: how much of the old surface's creases stays.
    /// Light tint: how much of the light's colour the texture takes; unset: as far as the plate
    /// gives evidence of it.
    std::optional<double> cast;
    double highlights = 0;   ///< Keep highlights: how much of the old surface's gloss stays.
    double roughness = 0;    ///< Of these highlights, 0–1.
    std::string albedo;      ///< Pattern of the albedo (unlit colour) pass.
    std::string lighting;    ///< Pattern of the lighting pass.
    std::string pass_layer;  ///< EXR layers of these two passes, joined by "+"; empty: found.
    bool exact = false;      ///< Uses their light unchanged, not relative to the reference frame's.
    Extras extra;
    bool operator==(const LightParams&) const = default;
};

/// Colour correction of the texture before it is lit, in linear light of the working space.
struct GradeParams {
    double match = 1;        ///< Match plate: how far the exposure follows the plate's, 0–1.
    double exposure = 0;     ///< Stops.
    double temperature = 0;  ///< Mired; above 0 is warmer.
    RgbNumbers multiply{1, 1, 1}, offset{0, 0, 0};
    double contrast = 1, gamma = 1, saturation = 1;
    double hue_deg = 0;
    Extras extra;
    bool operator==(const GradeParams&) const = default;
};

/// How the new surface goes over the old one.
struct LayerParams {
    double opacity = 1;
    BlendMode blend = BlendMode::kNormal;
    Extras extra;
    bool operator==(const LayerParams&) const = default;
};

/// A correction on one frame: the texture at `from` belongs at `to`; plate pixels. Equal points pin
/// the texture in place.
struct CorrectionPin {
    PlatePoint from, to;
    bool operator==(const CorrectionPin&) const = default;
};

/// Camera effects that match the texture to the plate.
struct FinishParams {
    double grain = 1;         ///< Amount of the plate's grain; 0: none.
    double focus = 1;         ///< Amount of the plate's defocus; 0: none.
    std::string depth;        ///< Pattern of a depth pass that guides defocus.
    std::string depth_layer;  ///< Empty: found.
    /// Shutter angle, 360 is a full frame; unset: measured on the plate.
    std::optional<double> shutter_deg;
    Extras extra;
    bool operator==(const FinishParams&) const = default;
};

/// Ink lines that stay on top of the new texture.
struct LineParams {
    std::string files;     ///< Pattern of the ink's coverage; empty: no line pass.
    bool invert = false;   ///< Ink is dark in the pass.
    bool extract = false;  ///< Without a pass: detect the ink in the plate.
    double width_px = 4;   ///< Widest stroke to detect.
    Extras extra;
    bool operator==(const LineParams&) const = default;
};

/// A surface that gets a new texture.
struct Region {
    RegionId id = 0;  ///< 0: not in a project yet.
    std::string name;
    bool enabled = true;
    int color = 0;            ///< Index into the editor's palette.
    Leaf<MatteSource> matte;  ///< The full matte: the surface with hidden parts included.
    Leaf<std::vector<MatteSource>> holdouts;  ///< Mattes of what passes in front of the surface.
    Leaf<std::vector<Zone>> zones;            ///< Parts in which a setting has another value.
    TextureSource texture;
    Placement placement;
    FormParams form;
    /// The first one holds the placement; empty: the default frame.
    std::vector<int> reference_frames;
    std::map<int, std::vector<CorrectionPin>> corrections;  ///< By frame; at least one pin each.
    MotionSource motion;
    /// Locked and regenerated patches of the synthesized texture. An edit that changes the samples
    /// clears them.
    Leaf<std::vector<PlaneAmendment>> amendments;
    SynthesisParams synthesis;
    TemporalParams temporal;
    LightParams light;
    GradeParams grade;
    LayerParams layer;
    FinishParams finish;
    LineParams lines;
    Extras extra;
    bool operator==(const Region&) const = default;
};

/// A shot. Copies are cheap, because regions are shared.
struct Project {
    std::string name;
    Plate plate;
    ColorSettings color;
    RenderSettings settings;
    Output output;
    std::vector<Leaf<Region>> regions;  ///< Layers, later ones on top.
    RegionId next_region_id = 1;        ///< Larger than every id ever used.
    Extras extra;
    bool operator==(const Project&) const = default;
};

/// Finds a region by its name or, failing that, by its id in digits. Errors: Usage when there is
/// none (the message lists the regions) or the name is ambiguous.
[[nodiscard]] Expected<std::size_t> find_region(const Project& project,
                                                std::string_view name_or_id);
/// The region of this id, or null.
[[nodiscard]] const Region* region_by_id(const Project& project, RegionId id);

/// Adds a --matte or --holdout value: "12=a.png" is a painted keyframe, any other text a pattern.
/// Errors: Usage when both kinds are given, or two of one kind contradict each other.
[[nodiscard]] Status add_matte_text(MatteSource& matte, std::string_view text);
/// Adds confirmed parts of a matte as --matte-confirmed takes them: FRAME=MATTE,AREA. Errors:
/// Usage.
[[nodiscard]] Status add_confirmed_text(MatteSource& matte, std::string_view text);

/// Replaces every path of the project (plate, mattes, textures, motion, light, output) by the
/// result of `visit`, in the file's order. Empty paths are skipped.
[[nodiscard]] Project map_paths(const Project& project,
                                const std::function<std::string(const std::string&)>& visit);

/// Estimated memory in bytes of a region without its leaves, and of a project without its regions,
/// for limiting the undo history.
[[nodiscard]] std::size_t own_bytes(const Region& region);
[[nodiscard]] std::size_t own_bytes(const MatteSource& matte);
[[nodiscard]] std::size_t own_bytes(const std::vector<Zone>& zones);
[[nodiscard]] std::size_t own_bytes(const std::vector<PlaneAmendment>& amendments);
[[nodiscard]] std::size_t own_bytes(const Project& project);

}  // namespace weft

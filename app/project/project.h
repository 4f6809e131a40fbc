#pragma once
// The document: an immutable value. Editing, undo, jobs, the command line and the editor all use
// this one. The only way to change it is an Edit (edit.h); every number and choice in it is
// described once, in parameters.h; docs/FORMATS.md describes the file.

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
#include "engine/compute/wrap_mode.h"
#include "engine/core/error.h"
#include "engine/core/fields.h"
#include "engine/core/keyed_numbers.h"
#include "engine/lighting/lamp.h"
#include "engine/lighting/light_source.h"
#include "engine/lighting/shading.h"
#include "engine/mask/matte_reach.h"
#include "engine/mask/roto_shape.h"
#include "engine/media/image_files.h"
#include "engine/pipeline/layer_kind.h"
#include "engine/seam/seam.h"
#include "engine/seam/seam_cost.h"
#include "engine/synthesis/plane_amendment.h"
#include "engine/temporal/temporal_mode.h"

namespace weft {

/// A point on the plate in full-resolution pixels, origin top-left, y down.
struct PlatePoint {
    double x = 0, y = 0;
    bool operator==(const PlatePoint&) const = default;
};

/// Stable name of a region inside its project, from 1; never given twice. It keys the region's
/// random numbers and cached analysis, so it must survive renaming and reordering.
using RegionId = std::uint32_t;

/// What stands for a frame that the plate has not.
enum class MissingFrames {
    kError,
    kHold,   ///< The frame before it.
    kBlack,  ///< A black frame.
    kSkip    ///< Nothing is rendered.
};

/// The sequence whose surfaces are replaced.
struct Plate {
    std::string path;        ///< Pattern ("frames/####.png"), folder or movie.
    std::string layer;       ///< EXR layer; empty: the file's R, G, B.
    int movie_start = 1001;  ///< Number of a movie's first frame.
    std::string space;       ///< Colour space; empty: by the file type.
    double fps = 0;          ///< 0: as the files say, else 24.
    MissingFrames missing = MissingFrames::kError;
    Extras extra;
    bool operator==(const Plate&) const = default;
};

/// Colour spaces of the shot; empty: by the file type (textures, output) or linear (working).
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
    /// Licences and families of them that no texture of this project may be under, by commas.
    std::string excluded_licences;
    Extras extra;
    bool operator==(const RenderSettings&) const = default;
};

enum class OutputDepth { kAuto, k8, k16, kHalf, kFloat };

/// Where the result goes.
struct Output {
    std::string path;  ///< Pattern of the numbered images.
    OutputDepth depth =
        OutputDepth::kAuto;  ///< kAuto: the plate's, or the nearest the format holds.
    int jpeg_quality = 95;
    std::string exr_compression = "auto";
    std::string movie;              ///< Review movie (.mp4, .mkv); empty: none.
    bool burn_in = false;           ///< The movie names frame, version and colour space.
    std::vector<LayerKind> layers;  ///< For compositing, each once.
    std::string layers_path;        ///< EXR files of their own for them; empty: into the output.
    Extras extra;
    bool operator==(const Output&) const = default;
};

/// A matte painted on one frame.
struct MatteKeyframe {
    std::string path;
    std::optional<RotoShape> shape = {};  ///< The roto shape that the matte was drawn from.
    bool shape_between = false;  ///< That shape was interpolated between those of other frames.
    Extras extra = {};
    bool operator==(const MatteKeyframe&) const = default;
};

/// A matte over time: either a file for each frame, or painted keyframes to be propagated.
struct MatteSource {
    std::string files;                       ///< Pattern; empty: keyframes.
    std::map<int, MatteKeyframe> keyframes;  ///< By frame number.
    MatteSelect select;
    double steadiness = 0.5;   ///< 0–1: how much boil is taken out of propagated mattes.
    std::vector<int> frozen;   ///< Frames whose mattes are read, not propagated …
    std::string frozen_files;  ///< … from files of this pattern.
    /// Which way painted mattes are carried, and between which frames; unset ends are the shot's.
    PropagationDirection carry = PropagationDirection::kBoth;
    std::optional<int> carry_from, carry_to;
    Extras extra;
    [[nodiscard]] bool empty() const {
        return files.empty() && keyframes.empty() && select.crypto.empty();
    }
    bool operator==(const MatteSource&) const = default;
};

/// Whether a texture is named by its place in a texture library ("db:ID") and not by a file.
[[nodiscard]] inline bool names_library_texture(std::string_view path) {
    return path.starts_with("db:");
}

/// What is put on the surface: a sample to grow a plane from, or a given plane; files, or textures
/// of a library.
struct TextureSource {
    std::string sample;
    std::vector<std::string> also;      ///< Further samples of the same material.
    std::string plane;                  ///< Used as it is, without synthesis.
    WrapMode wrap = WrapMode::kRepeat;  ///< What lies beyond the border of `plane`.
    std::string space;                  ///< Empty: the project's texture space.
    Extras extra;
    bool operator==(const TextureSource&) const = default;
};

/// Where the texture lies on the plate of the reference frame.
struct Placement {
    double scale = 1;       ///< Plate pixels per sample pixel at the placement's origin.
    double rotate_deg = 0;  ///< Counter-clockwise as seen on screen.
    PlatePoint offset_px;
    /// Where the texture's corners go (TL, TR, BR, BL): a perspective placement, inside which
    /// scale, rotation and offset act.
    std::optional<std::array<PlatePoint, 4>> corners_px;
    /// A given picture (a plane) is fitted into the corners; else `scale` holds there too.
    bool fit = true;
    /// Instead of the above, over time; an offset has two numbers, x and y.
    KeyedNumbers scale_keys, rotate_keys, offset_keys;
    std::string uv;        ///< Pattern of a UV pass or ST-map: where the texture lies, exactly.
    std::string uv_layer;  ///< Empty: found.
    Extras extra;
    bool operator==(const Placement&) const = default;
};

/// Where the surface's motion comes from.
struct MotionSource {
    std::string files;  ///< Pattern of true motion; empty: estimated from the plate.
    MotionDirection direction = MotionDirection::kForward;
    MotionConvention convention = MotionConvention::kFiles;
    std::string layer;  ///< EXR layer of the motion pass; empty: found.
    std::string track;  ///< File of a planar track that the surface follows instead.
    Extras extra;
    bool operator==(const MotionSource&) const = default;
};

struct SynthesisParams {
    SeamMethod seam = SeamMethod::kGraphCut;
    int overlap_px = 36;
    int feather_px = 0;
    SeamCost seam_cost = SeamCost::kGradient;
    int refine = 2;  ///< Rounds; as kDefaultRefinePasses.
    bool rotations = false, mirror = false;
    bool align = true;
    Extras extra;
    bool operator==(const SynthesisParams&) const = default;
};

struct TemporalParams {
    TemporalMode mode = TemporalMode::kLocked;
    double blend = 0.2;  ///< The paper's α (eq. 6).
    double weight = 1;   ///< The paper's λ_t (eq. 5).
    Extras extra;
    bool operator==(const TemporalParams&) const = default;
};

struct LightParams {
    LightSource source = LightSource::kPlate;
    std::string image;  ///< The illumination picture of kImage.
    LightForm form = LightForm::kGain;
    double strength = 1;         ///< λ
    KeyedNumbers strength_keys;  ///< λ over time; empty: `strength` throughout.
    std::vector<Lamp> lamps;     ///< Painted light, for kPainted.
    double cast = 0;             ///< How far the light's colour is taken over.
    double highlights = 0;       ///< How much of the old surface's gloss is kept.
    std::string albedo;          ///< Pattern of the artist's unlit colour.
    std::string lighting;        ///< Pattern of the artist's lighting pass.
    std::string pass_layer;      ///< EXR layer of these two; empty: R, G, B.
    bool exact = false;          ///< Their light as it is, not relative to the reference frame's.
    Extras extra;
    bool operator==(const LightParams&) const = default;
};

/// On one frame, what the texture shows at `from` belongs at `to`; plate pixels. `from` == `to`
/// holds a place.
struct CorrectionPin {
    PlatePoint from, to;
    bool operator==(const CorrectionPin&) const = default;
};

/// What makes the new texture look as if it had gone through the plate's camera.
struct FinishParams {
    double grain = 1;                   ///< Of the plate's grain; 0: none.
    double focus = 1;                   ///< Of the plate's blur; 0: none.
    std::string depth;                  ///< Pattern of a depth pass, along which blur is followed.
    std::optional<double> shutter_deg;  ///< Of 360 a frame; unset: as the plate's.
    Extras extra;
    bool operator==(const FinishParams&) const = default;
};

/// The ink lines that stay on top of the new texture.
struct LineParams {
    std::string files;     ///< Pattern of the ink's coverage; empty: no line pass.
    bool invert = false;   ///< The pass is dark where there is ink.
    bool extract = false;  ///< Without a pass: find the ink in the plate.
    double width_px = 4;   ///< The widest stroke that is found.
    Extras extra;
    bool operator==(const LineParams&) const = default;
};

/// One surface to be replaced.
struct Region {
    RegionId id = 0;  ///< 0: not in a project yet.
    std::string name;
    bool enabled = true;
    int color = 0;                            ///< Index into the editor's palette.
    Leaf<MatteSource> matte;                  ///< The extent: the surface, hidden parts included.
    Leaf<std::vector<MatteSource>> holdouts;  ///< What passes in front of it.
    TextureSource texture;
    Placement placement;
    std::vector<int> reference_frames;  ///< The first holds the placement; empty: the first frame.
    std::map<int, std::vector<CorrectionPin>> corrections;  ///< By frame; each has a pin or more.
    MotionSource motion;
    /// Places of the grown texture that are kept or made again. They belong to the texture: an edit
    /// that changes its samples drops them.
    Leaf<std::vector<PlaneAmendment>> amendments;
    SynthesisParams synthesis;
    TemporalParams temporal;
    LightParams light;
    FinishParams finish;
    LineParams lines;
    Extras extra;
    bool operator==(const Region&) const = default;
};

/// A shot. Copies are cheap: regions are shared.
struct Project {
    std::string name;
    Plate plate;
    ColorSettings color;
    RenderSettings settings;
    Output output;
    std::vector<Leaf<Region>> regions;  ///< Layers, later ones on top.
    RegionId next_region_id = 1;        ///< Above every id that was ever given.
    Extras extra;
    bool operator==(const Project&) const = default;
};

/// Index of a region by its name or, failing that, by its id in digits. Errors: Usage when there is
/// none (the message lists those there are) or the name stands for several.
[[nodiscard]] Expected<std::size_t> find_region(const Project& project,
                                                std::string_view name_or_id);
/// The region of this id, or null.
[[nodiscard]] const Region* region_by_id(const Project& project, RegionId id);

/// Adds what a --matte or --holdout of the command line says: "12=a.png" is a painted keyframe, any
/// other text a pattern. Errors: Usage when both are given, or two of one kind contradict each
/// other.
[[nodiscard]] Status add_matte_text(MatteSource& matte, std::string_view text);

/// Calls `visit` with every path of the project (plate, mattes, textures, motion, light, output),
/// in the file's order; what it returns becomes the path. Empty paths are skipped.
[[nodiscard]] Project map_paths(const Project& project,
                                const std::function<std::string(const std::string&)>& visit);

/// Bytes of memory of a region and of what only it holds (its leaves excluded), and of a project
/// without its regions: estimates for bounding the undo history.
[[nodiscard]] std::size_t own_bytes(const Region& region);
[[nodiscard]] std::size_t own_bytes(const MatteSource& matte);
[[nodiscard]] std::size_t own_bytes(const std::vector<PlaneAmendment>& amendments);
[[nodiscard]] std::size_t own_bytes(const Project& project);

}  // namespace weft

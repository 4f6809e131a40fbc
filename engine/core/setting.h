#pragma once
// The settings and commands that messages refer to. A message names them by key; the front end that
// runs says them in its own terms: flags on the command line (app/cli/setting_flags.h), labels in
// the editor (ui/parameters/setting_labels.h).

#include <array>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace weft {

/// A key that is a parameter's full key (app/project/parameters.h) is that parameter.
namespace setting {
inline constexpr std::string_view
    kAlbedo = "light.albedo",
    kBackend = "run.backend", kCache = "run.cache", kChunk = "submit.chunk",
    kCryptoFiles = "matte.crypto_files", kExcludedLicences = "settings.excluded_licences",
    kExrCompression = "output.exr_compression", kFeather = "synthesis.feather_px",
    kFrames = "settings.frames", kHighlights = "light.highlights", kHoldout = "holdouts",
    kLamps = "light.lamps", kLayers = "output.layers", kLayersOutput = "output.layers_path",
    kLibrary = "run.library", kLightExact = "light.exact", kLightLayer = "light.pass_layer",
    kLighting = "light.lighting", kLightSource = "light.source", kMatte = "matte",
    kMatteChannel = "matte.channel", kMatteFrozenFiles = "matte.frozen_files",
    kMatteInvert = "matte.invert", kMatteValue = "matte.value", kMemory = "run.memory",
    kMotion = "motion.files", kMotionConvention = "motion.convention",
    kMotionDirection = "motion.direction", kMotionLayer = "motion.layer",
    kMovieStart = "plate.movie_start", kOutput = "output.path", kOutputRoot = "run.output_root",
    kOverlap = "synthesis.overlap_px", kOverwrite = "run.overwrite", kPackages = "library.packages",
    kPlane = "texture.plane", kPlate = "plate.path", kPlateLayer = "plate.layer",
    kPlateSpace = "plate.space", kDepth = "finish.depth", kDepthLayer = "finish.depth_layer",
    kFormShape = "form.shape", kFormSource = "form.source", kFormStrokes = "form.strokes",
    kFov = "form.fov_deg", kNormalLayer = "form.normal_layer", kNormalSpace = "form.normal_space",
    kPositionLayer = "form.position_layer", kPositionPass = "form.position", kRecipe = "run.recipe",
    kReferenceFrame = "reference_frames", kRegion = "look.region", kRestart = "run.restart",
    kResume = "run.resume", kSample = "texture.sample", kSkipExisting = "run.skip_existing",
    kTemporalMode = "temporal.mode", kTextureSpace = "color.texture_space", kTrack = "motion.track",
    kTrustOnce = "run.trust", kTruth = "measure.truth", kUvLayer = "placement.uv_layer",
    kVersionUp = "run.version_up", kWarp = "placement.warp", kZone = "zones";
// Commands.
inline constexpr std::string_view kAddRegion = "command.add_region",
                                  kBuildLibrary = "command.build_library",
                                  kImportTextures = "command.import_textures",
                                  kListTextures = "command.list_textures",
                                  kListTrusted = "command.list_trusted",
                                  kSaveLook = "command.save_look",
                                  kTrainLibrary = "command.train_library",
                                  kTrustFolder = "command.trust_folder",
                                  kUseModel = "command.use_model",
                                  kVerifyLibrary = "command.verify_library";
inline constexpr std::array kAll{
    kAlbedo,       kExrCompression,   kBackend,       kCache,        kChunk,          kCryptoFiles,
    kDepth,        kExcludedLicences, kFeather,       kFormShape,    kFormSource,     kFormStrokes,
    kFov,          kFrames,           kHighlights,    kHoldout,      kLamps,          kLayers,
    kLayersOutput, kLibrary,          kLightExact,    kLightSource,  kLighting,       kMatte,
    kMatteChannel, kMatteFrozenFiles, kMatteInvert,   kMatteValue,   kMemory,         kMotion,
    kMotionLayer,  kMovieStart,       kNormalLayer,   kNormalSpace,  kOutput,         kOutputRoot,
    kOverlap,      kOverwrite,        kPackages,      kPlane,        kPlate,          kPlateLayer,
    kPlateSpace,   kPositionLayer,    kPositionPass,  kRecipe,       kReferenceFrame, kRegion,
    kRestart,      kResume,           kSample,        kSkipExisting, kTemporalMode,   kTextureSpace,
    kTrack,        kTrustOnce,        kTruth,         kVersionUp,    kZone,           kAddRegion,
    kBuildLibrary, kImportTextures,   kListTextures,  kListTrusted,  kSaveLook,       kTrainLibrary,
    kTrustFolder,  kMotionDirection,  kVerifyLibrary, kWarp,         kDepthLayer,     kLightLayer,
    kUvLayer,      kMotionConvention, kUseModel};
}  // namespace setting

/// A setting and, where it should get one, its value: {"reference_frames", "1012"}.
struct SettingRef {
    std::string_view key;
    std::string value{};
};

/// "--matte", "--reference-frame 1012", "Reference frames: 1012"; empty: this front end has no such
/// setting.
using SettingNamer = std::string (*)(const SettingRef&);

/// Sets how this process names settings: once, before a message is composed. Without it they are
/// named by their keys. Thread-safe.
void set_setting_namer(SettingNamer namer);

/// One setting in the front end's terms. Thread-safe.
[[nodiscard]] std::string setting_name(const SettingRef& setting);

/// What a remedy is done with, for the end of its sentence: " (--texture, --plane)"; empty where
/// the front end has none of the settings. Thread-safe.
[[nodiscard]] std::string by(std::initializer_list<SettingRef> settings);
[[nodiscard]] std::string by(std::span<const SettingRef> settings);

}  // namespace weft

#pragma once
// The layers that a render can write for compositing (docs/FORMATS.md#layers).

#include <array>
#include <string_view>

namespace weft {

enum class LayerKind {
    kPatch,
    kEdge,
    kLight,
    kLightConfidence,
    kGloss,
    kSt,
    kMatte,
    kSeam,
    kId,
    kTexture,
    kFinish,
    kNormal,
    kDepth,
    kFormConfidence
};

struct LayerInfo {
    LayerKind kind;
    std::string_view name;  ///< Of the EXR layer, on the command line and in the project file.
    std::string_view help;  ///< One line in sentence case, without a full stop.
};
/// All of them, in the order in which they stand in files.
inline constexpr std::array<LayerInfo, 14> kLayers{
    {{LayerKind::kPatch, "patch", "The new texture with its coverage, premultiplied"},
     {LayerKind::kEdge, "edge", "What soft edges take away of the old surface"},
     {LayerKind::kLight, "light", "What the texture was multiplied by"},
     {LayerKind::kLightConfidence, "light_confidence",
      "How surely light and paint of the old surface were told apart"},
     {LayerKind::kGloss, "gloss", "Highlights of the old surface, added to the lit texture"},
     {LayerKind::kSt, "st", "ST-map: the place in the texture that each pixel shows"},
     {LayerKind::kMatte, "matte", "Coverage of all regions"},
     {LayerKind::kSeam, "seam", "Where a seam of the synthesized texture shows"},
     {LayerKind::kId, "id", "The region's number"},
     {LayerKind::kTexture, "texture", "The texture before light"},
     {LayerKind::kFinish, "finish", "What comes after light and gloss: grain, ink, blending"},
     {LayerKind::kNormal, "normal", "Normal of the form found, in the camera's axes"},
     {LayerKind::kDepth, "depth", "Depth of the form found, along the camera's axis"},
     {LayerKind::kFormConfidence, "form_confidence", "How sure the form is, 0 where it is flat"}}};

/// Whether a layer shows the form of surfaces.
[[nodiscard]] constexpr bool shows_form(LayerKind kind) {
    return kind >= LayerKind::kNormal;
}

[[nodiscard]] constexpr const LayerInfo& info_of(LayerKind kind) {
    return kLayers[static_cast<std::size_t>(kind)];
}

}  // namespace weft

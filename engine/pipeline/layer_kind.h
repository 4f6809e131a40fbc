#pragma once
// The layers that a render can write for compositing (docs/FORMATS.md#layers).

#include <array>
#include <string_view>

namespace weft {

enum class LayerKind { kPatch, kEdge, kLight, kLightConfidence, kGloss, kSt, kMatte, kSeam, kId };

struct LayerInfo {
    LayerKind kind;
    std::string_view name;  ///< Of the EXR layer, on the command line and in the project file.
    std::string_view help;  ///< One line in sentence case, without a full stop.
};
/// All of them, in the order in which they stand in files.
inline constexpr std::array<LayerInfo, 9> kLayers{
    {{LayerKind::kPatch, "patch", "The new texture with its coverage, premultiplied"},
     {LayerKind::kEdge, "edge", "What soft edges take away of the old surface"},
     {LayerKind::kLight, "light", "What the texture was multiplied by"},
     {LayerKind::kLightConfidence, "light_confidence",
      "How surely light and paint of the old surface were told apart"},
     {LayerKind::kGloss, "gloss", "Highlights of the old surface, added to the lit texture"},
     {LayerKind::kSt, "st", "ST-map: the place in the texture that each pixel shows"},
     {LayerKind::kMatte, "matte", "Coverage of all regions"},
     {LayerKind::kSeam, "seam", "Where a seam of the synthesized texture shows"},
     {LayerKind::kId, "id", "The region's number"}}};

[[nodiscard]] constexpr const LayerInfo& info_of(LayerKind kind) {
    return kLayers[static_cast<std::size_t>(kind)];
}

}  // namespace weft

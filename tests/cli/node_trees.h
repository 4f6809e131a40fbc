#pragma once
// Small evaluators of node trees of Nuke and Fusion: every node by itself, as the programs' manuals
// say. They know what app/composites writes and fail a test at anything else.

#include <array>
#include <map>
#include <string>
#include <vector>

#include "engine/core/image.h"

namespace weft::test {

/// The names of a file's channels.
std::vector<std::string> exr_channels(const std::string& path);
/// One channel of a file, by its whole name ("light.R"); fails the test if it is not there.
ImageF1 exr_channel(const std::string& path, const std::string& name);

/// What a node gives: red, green, blue, alpha.
using Rgba = std::array<ImageF1, 4>;

/// A file of colours: R, G and B of an EXR, codes of 0–1 of others; alpha 1 if it has none.
Rgba read_rgba(const std::string& path);

struct TreeRun {
    std::string folder;  ///< Of the script.
    int frame = 0;
    int texture = 0;  ///< 0: as rendered; 1: the plane through the ST-map.
};

/// The picture that the last node of a script gives.
Rgba evaluate_nuke(const std::string& script, const TreeRun& run);
Rgba evaluate_fusion(const std::string& composition, const TreeRun& run);

/// Between the centres of four texels; `wraps`: repeated, else the edge goes on.
float sample(const ImageF1& picture, float s, float t, bool wraps);
/// sRGB to linear light.
float linear_from_srgb(float code);

}  // namespace weft::test

#pragma once
// Node trees for other programs that rebuild a render from its plate and layers. The texture comes
// as it was rendered (the layer `texture`) or from the texture plane through the ST-map, by one
// switch; then light is multiplied, gloss and the layer `finish` are added, the holdout is the
// coverage, and the plate is laid beneath (docs/FORMATS.md). Pure texts; the same values give the
// same bytes.

#include <string>
#include <vector>

#include "engine/core/geometry.h"

namespace weft {

/// What makes the plate's codes linear light.
enum class PlateCurve { kNone, kSrgb, kCineon };

/// Pictures of all frames, or one picture for all of them.
struct CompositePictures {
    /// A path with / from the script's folder, with its number in printf notation ("../a.%04d.exr")
    /// unless it is one picture.
    std::string pattern;
    std::string first;  ///< The path on the first frame.
    bool numbered = true;
};

/// The texture plane of a region, in the working space and graded.
struct CompositePlane {
    std::string region;  ///< Its name.
    int id = 0;          ///< In the layer `id`.
    std::string path;    ///< An EXR, from the script's folder.
};

struct Composite {
    Size size;  ///< Of the plate, px.
    double pixel_aspect = 1, fps = 24;
    int first = 1, last = 1;  ///< Frames.
    CompositePictures plate, layers;
    std::string plate_layer;  ///< Of an EXR; empty: R, G, B.
    PlateCurve curve = PlateCurve::kNone;
    std::vector<CompositePlane> planes;  ///< None: there is no switch.
    bool one_region = true;              ///< There is no other region than that of the plane.
};

/// In every tree, near its beginning.
inline constexpr const char* kCompositeMark = "Rebuilds a render of Weft from its plate and layers";

/// A Nuke script: open it, or insert its nodes and set the folder in the node Weft_folder.
[[nodiscard]] std::string nuke_composite(const Composite& composite);
/// A composition of Fusion.
[[nodiscard]] std::string fusion_composite(const Composite& composite);
/// A Python script for Blender's text editor or `blender --python`. PlateCurve::kCineon is not
/// supported: Blender has no such curve.
[[nodiscard]] std::string blender_composite(const Composite& composite);

}  // namespace weft

#pragma once
// Which of a region's passes shows its form, and what it shows.

#include <string>

#include "app/project/project.h"
#include "engine/core/hash.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

/// The pass that decides, by FormParams::source.
struct FormFiles {
    RegionPlan::FormFrom from = RegionPlan::FormFrom::kNothing;
    std::string pattern;    ///< Empty without one, for motion and for a shape.
    std::string what = {};  ///< "The position pass"
};
/// Whether that source is a pass.
[[nodiscard]] bool reads_form(RegionPlan::FormFrom from);
[[nodiscard]] FormFiles form_files(const Region& region);

/// Hashes all settings on which what the pass shows depends, but the files themselves.
void add_form_settings(Hasher& hasher, const Region& region);

/// What passes are read for.
struct PassPlate {
    Size size;
    PixelAspect aspect = {};
};

/// The places that one file of the pass shows, from a position or a depth pass. Errors: those of
/// reading; Unreadable if a depth pass comes without a field of view.
[[nodiscard]] Expected<ImageF3> read_form_places(const Region& region, const std::string& path,
                                                 const PassPlate& plate);
/// The axes of a normal pass.
enum class NormalAxes {
    kCamera,
    kPresumedCamera,  ///< Nothing tells.
    kWorld
};
/// As set; else as the layer's name and the renderer tell.
[[nodiscard]] NormalAxes axes_of_normals(const FormParams& form, const std::string& path);

/// The normals that one file of the pass shows. Errors: those of reading; Unreadable if there is no
/// field of view, or if they are in the world's axes and neither the header nor a position pass in
/// the same file tells the camera's.
[[nodiscard]] Expected<NormalPass> read_form_normals(const Region& region, const std::string& path,
                                                     const PassPlate& plate);

}  // namespace weft

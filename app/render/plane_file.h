#pragma once
#include <string>

#include "app/shot/shot.h"
#include "engine/color/grade.h"
#include "engine/compute/plane_pyramid.h"
#include "engine/media/frame_writer.h"

namespace weft {

/// Checks that the shot has one plane that a file of this name can hold. Errors: Usage if there are
/// several regions, if the region's texture is made anew for every frame, or if the name ends
/// neither in .png nor in .exr.
[[nodiscard]] Status check_plane_file(const std::string& path, const ShotPlan& plan);

/// Writes the texture plane of the shot's region without light, in the texture's colour space, as
/// PNG of 16 bit or EXR of 32 bit floats. "weft:plane" in its header is its size in texels, "WxH";
/// `write` gives the other metadata and the rule. Errors: as write_image().
[[nodiscard]] Status write_plane_file(const std::string& path, const PlanePyramid& plane,
                                      const ShotSpaces& spaces, WriteOptions write);

/// Writes a plane in the working space with the region's grade, as the layer `texture` has it: an
/// EXR of 32 bit floats, otherwise as write_plane_file().
[[nodiscard]] Status write_graded_plane(const std::string& path, const PlanePyramid& plane,
                                        const Grade& grade, WriteOptions write);

}  // namespace weft

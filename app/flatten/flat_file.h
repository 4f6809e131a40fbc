#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/shot/shot.h"
#include "engine/media/frame_writer.h"
#include "engine/pipeline/flat_surface.h"

namespace weft {

/// Errors: Usage if the name ends in none of .png, .tif, .tiff, .exr and .ora.
[[nodiscard]] Status check_flat_file(const std::string& path);
[[nodiscard]] bool is_open_raster(const std::string& path);

struct FlatPictures {
    const FlatSurface& surface;
    const ImageF3* texture = nullptr;  ///< As it lies there, working space; null: none.
};
/// Writes them; returns the names of an .ora's layers, bottom first. Errors: as write_image().
[[nodiscard]] Expected<std::vector<std::string>> write_flat_file(const std::string& path,
                                                                 const FlatPictures& pictures,
                                                                 const ShotSpaces& spaces,
                                                                 WriteOptions write);

}  // namespace weft

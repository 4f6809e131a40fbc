#pragma once
// Internal: selects the channels of a file that form the picture, by their names alone.

#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/media/raster.h"

namespace weft {

/// The names in one part of a file.
struct PartNames {
    std::string name;  ///< "" if the file does not name its parts.
    std::vector<std::string> channels;
    int alpha = -1;     ///< As the format marks it; −1: none.
    bool deep = false;  ///< Any number of samples per pixel: not a picture.
};

struct ChannelChoice {
    int part = 0;
    std::vector<int> channels;  ///< In the part: 1 or 3 colours, then alpha.
    bool has_alpha = false;
};

/// Without a layer in the request: R, G, B of the first part that is not named as data (depth,
/// normals, ids, motion, …), else the one layer that is named as the whole picture (beauty, rgba,
/// combined), else a grey channel. Depth and other data are only read if their layer or channel is
/// requested by name. Errors: Unreadable, listing the layers or channels of the file.
[[nodiscard]] Expected<ChannelChoice> choose_channels(const std::string& path,
                                                      const std::vector<PartNames>& parts,
                                                      const RasterRequest& request, bool exr);

}  // namespace weft

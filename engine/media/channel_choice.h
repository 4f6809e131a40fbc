#pragma once
// Internal: which channels of a file make the picture. Works on names alone.

#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/media/raster.h"

namespace weft {

/// The names in one part of a file.
struct PartNames {
    std::string name;  ///< "" where the file does not name its parts.
    std::vector<std::string> channels;
    int alpha = -1;     ///< As the format marks it; −1: none.
    bool deep = false;  ///< Any number of samples a pixel: no picture.
};

struct ChannelChoice {
    int part = 0;
    std::vector<int> channels;  ///< In the part: 1 or 3 colours, then alpha.
    bool has_alpha = false;
};

/// Without a layer in the request: R, G, B of the first part that is not named as data (depth,
/// normals, ids, motion, …), else the one layer that is named as the whole picture (beauty, rgba,
/// combined), else a grey channel. Depth and other data are never taken unless the layer or the
/// channel is asked for by name. Errors: Unreadable, listing the layers or channels that there are.
[[nodiscard]] Expected<ChannelChoice> choose_channels(const std::string& path,
                                                      const std::vector<PartNames>& parts,
                                                      const RasterRequest& request, bool exr);

}  // namespace weft

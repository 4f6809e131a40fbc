#pragma once
// OpenRaster (https://www.openraster.org, 0.0.5), which Krita, MyPaint and others paint in: a zip
// archive of a PNG for each layer, the order of the layers as XML, and the picture that they make
// together. Krita's own documents hold that picture in the same way.

#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/media/frame_writer.h"

namespace weft {

struct OpenRasterLayer {
    std::string name;  ///< UTF-8.
    ViewF3 rgb;        ///< Straight, encoded as a display has it (sRGB).
    ViewF1 alpha;      ///< Of its size; empty: opaque.
    bool visible = true;
};

/// Writes layers of one size, bottom first, with 8 bits: Krita asks for a profile of each picture
/// with 16, and proposes a linear one. NaN is black. `options`: rule and metadata. The same
/// bytes for the same pictures. Errors: as write_image(); Usage if layers differ in size.
[[nodiscard]] Status write_open_raster(const std::string& path,
                                       const std::vector<OpenRasterLayer>& layers,
                                       const WriteOptions& options);

}  // namespace weft

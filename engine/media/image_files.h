#pragma once
// Single pictures: textures, mattes, motion fields.

#include <optional>
#include <string>

#include "engine/core/error.h"
#include "engine/core/fields.h"
#include "engine/media/frame_reader.h"

namespace weft {

/// Reads any format OpenImageIO knows. Errors: Unreadable (missing, truncated, not an image), with
/// the path; NoSpace when it would not fit into memory.
[[nodiscard]] Expected<PlateFrame> read_image(const std::string& path,
                                              const std::string& layer = {});

/// Which part of a matte file is the matte.
struct MatteSelect {
    /// An id matte: 255 where the (integer) pixel equals it, else 0. Looked up in `channel`, or in
    /// the first one; of a palette file the ids are the indices, not the colours.
    std::optional<int> value;
    std::string channel;  ///< "R", "G", "B", "A", "Y" (luma) or a channel's name; empty: A
                          ///< when the file has an alpha that is not all opaque, else Y.
    bool invert = false;
    bool operator==(const MatteSelect&) const = default;
};

/// Coverage 0–255, of any size when `expected` is empty (rounded; 16-bit and float files are
/// quantised). Errors: MissingFrames when the file is not there, Unreadable when it is no image,
/// has no such channel, or its size differs from `expected` (the message gives both sizes); Usage
/// for `value` on a float file.
[[nodiscard]] Expected<Matte> read_matte(const std::string& path, const MatteSelect& select,
                                         Size expected);

/// `.flo` (Middlebury) or 16-bit PNG in the KITTI encoding. Unknown motion has d = 0 and valid = 0.
/// Errors as read_matte().
[[nodiscard]] Expected<FlowField> read_flow(const std::string& path, Size expected);
/// In steps of 1/64 px. Motion of 512 px and more does not fit and is written as unknown. Errors as
/// write_image().
[[nodiscard]] Status write_flow_kitti(const std::string& path, const FlowField& flow);

}  // namespace weft

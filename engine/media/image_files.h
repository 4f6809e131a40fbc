#pragma once
// Single pictures: textures, mattes, motion fields.

#include <optional>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/fields.h"
#include "engine/media/frame_reader.h"
#include "engine/media/pass_layers.h"

namespace weft {

/// Reads any format of OpenImageIO. Errors: Unreadable (missing, truncated, not an image), with the
/// path; NoSpace if it does not fit into memory.
[[nodiscard]] Expected<PlateFrame> read_image(const std::string& path,
                                              const std::string& layer = {});

/// Selects the matte in a matte file.
struct MatteSelect {
    /// An ID matte: 255 where the pixel, an integer or a float without a fraction, equals it, else
    /// 0. Read from `channel`, else from the layer IndexOB, IndexMA or id beside a renderer's
    /// picture, else from the first channel; in a palette file the ids are the indices, not the
    /// colours.
    std::optional<int> value;
    std::string channel;  ///< "R", "G", "B", "A", "Y" (luma) or a channel's name; empty: A
                          ///< when the file has an alpha that is not all opaque, else Y.
    bool invert = false;
    /// Cryptomatte objects by name, separated by commas (engine/media/cryptomatte.h). The other
    /// members except `invert` are then ignored.
    std::string crypto = {};
    bool operator==(const MatteSelect&) const = default;
};

/// The channel of a sequence of mattes for which none is given: "A" if the alpha of any of up to 24
/// of them, spread over all, is not opaque everywhere, else "Y"; empty, which leaves the choice to
/// each file, if one of those has no alpha or cannot be read. An element that fills one frame is
/// opaque there, and still read by its alpha.
[[nodiscard]] std::string channel_of_mattes(const std::vector<std::string>& paths);

/// Where the ids are in a renderer's file, beside its picture; of several layers that beside one of
/// `beside`: find_pass(). Nothing if there are none, or the file has no other layers.
[[nodiscard]] std::optional<FoundPass> find_ids(const std::string& path,
                                                const std::vector<std::string>& beside = {});

/// Coverage 0–255, of any size if `expected` is empty (rounded; 16-bit and float files are
/// quantised). Errors: MissingFrames if there is no such file; Unreadable if it is not an image,
/// lacks the channel, or differs in size from `expected` (the message gives both sizes); Usage for
/// `value` where the samples have fractions, and for a movie, which MatteFiles reads.
[[nodiscard]] Expected<Matte> read_matte(const std::string& path, const MatteSelect& select,
                                         Size expected);

/// `.flo` (Middlebury) or 16-bit PNG in the KITTI encoding. Unknown motion has d = 0 and valid = 0.
/// Errors as read_matte().
[[nodiscard]] Expected<FlowField> read_flow(const std::string& path, Size expected);
/// How a pass encodes motion. In renderers' vectors y points up.
enum class MotionConvention {
    kFiles,    ///< .flo and KITTI: read_flow().
    kBlender,  ///< Cycles' Vector pass: pixels; X, Y to the previous frame, Z, W from the next.
    kNuke,     ///< forward.u, .v and backward.u, .v: pixels.
    kMoonray,  ///< R, G: screen space, −1 to 1 over the width, premultiplied by alpha.
    kFlame,    ///< R, G: shares of the picture's size.
    kArnold    ///< R, G of motionvector, raw: pixels.
};
struct MotionSelect {
    MotionConvention convention = MotionConvention::kFiles;
    MotionDirection direction = MotionDirection::kForward;
    /// The part of the channels' names before ".X", or a part's name; empty: detected.
    std::string layer = {};
};
/// Where read_motion() reads a renderer's pass; of several layers that beside one of `beside`:
/// find_pass(). Errors: as there.
[[nodiscard]] Expected<FoundPass> locate_motion(const std::string& path, const MotionSelect& select,
                                                const std::vector<std::string>& beside = {});
/// The motion to the next or the previous frame, H×W×2 pixels, y down. Unknown where a vector is
/// longer than twice the picture, or Cycles' 10000 beside its render region. Errors: as
/// read_flow(); Unreadable, listing the layers, if there is no such pass.
[[nodiscard]] Expected<FlowField> read_motion(const std::string& path, const MotionSelect& select,
                                              Size expected);

/// A UV pass or an ST-map: two channels (U, V, or X, Y as Blender's File Output node writes them,
/// or R, G) in 0–1, origin at the bottom left; larger where a texture repeats. NaN where the pass
/// says that it does not cover a pixel wholly. `layer`: the part of the names before ".U", or a
/// part's name; empty: "UV" or "ST", also behind another name, else R, G of a file that has no
/// other layer. Errors: as read_motion().
[[nodiscard]] Expected<ImageF2> read_uv(const std::string& path, const std::string& layer,
                                        Size expected);
/// Where read_uv() reads; of several layers that beside one of `beside`: find_pass().
[[nodiscard]] Expected<FoundPass> locate_uv(const std::string& path, const std::string& layer,
                                            const std::vector<std::string>& beside = {});

/// Errors: MissingFrames if there is no such file.
[[nodiscard]] Status check_picture_exists(const std::string& path);

/// In steps of 1/64 px. Motion of 512 px and more does not fit and becomes unknown. Errors: as
/// write_image().
[[nodiscard]] Status write_flow_kitti(const std::string& path, const FlowField& flow);

}  // namespace weft

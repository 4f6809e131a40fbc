#pragma once
// Reads plates: numbered images and movies behind one interface, decoded frame by frame on demand.

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/alpha.h"
#include "engine/core/error.h"
#include "engine/core/hash.h"
#include "engine/core/image.h"
#include "engine/media/file_color.h"

namespace weft {

enum class PixelDepth { kU8, kU16, kHalf, kFloat };

/// One decoded frame. Integer depths are scaled to [0, 1] by 1/255 or 1/65535, so that writing the
/// same depth gives the same codes back; half and float keep the file's values.
struct PlateFrame {
    ImageF3 rgb;                                  ///< H×W×3; a grey file's value is in all three.
    ImageF1 alpha;                                ///< H×W; empty if the file has none.
    AlphaKind alpha_kind = AlphaKind::kStraight;  ///< Of rgb, as the file holds it.
    PixelDepth depth = PixelDepth::kU8;
    std::int64_t nonfinite = 0;  ///< Pixels with a NaN or infinite component.
    FileColor color = {};        ///< The file's colour information.
};

struct ReadOptions {
    std::string layer;  ///< EXR layer ("beauty" reads beauty.R, .G, .B); empty: R, G, B.
    /// The number of a movie's first frame, or of a single picture without a number in its name.
    int movie_start = 1001;
    /// Width of a pixel over its height, whatever the files say; empty: as they say.
    std::optional<double> pixel_aspect = {};
    /// How many frames of a movie have been counted so far, for who waits for it; null: nobody
    /// does.
    std::shared_ptr<std::atomic<int>> counted = {};
};

/// A plate. read() may be called from several threads; a movie serialises them inside.
class FrameReader {
  public:
    virtual ~FrameReader() = default;
    [[nodiscard]] virtual const std::vector<int>& frames() const = 0;  ///< Ascending, as on disk.
    [[nodiscard]] virtual Size size() const = 0;                       ///< Of the first frame.
    [[nodiscard]] virtual double fps() const = 0;  ///< 0 when the files do not say.
    [[nodiscard]] virtual PixelDepth depth() const = 0;
    [[nodiscard]] virtual bool display_encoded()
        const = 0;  ///< Values are spread as a display or a film scan has them, not linear.
    /// Colour information of the first frame.
    [[nodiscard]] virtual FileColor color() const {
        return {display_encoded() ? "srgb" : "linear", {}};
    }
    [[nodiscard]] virtual std::string path_of(int frame) const = 0;
    /// Errors: MissingFrames (no such file), Unreadable (truncated, not an image, another size than
    /// the first frame); each message names the file and the remedy.
    [[nodiscard]] virtual Expected<PlateFrame> read(int frame) const = 0;
    /// Changes whenever the frame's file may have changed (path, FileStamp).
    [[nodiscard]] virtual Expected<Hash128> stamp(int frame) const = 0;
    /// Problems of a plate that can nevertheless be read (a movie that claims more frames).
    [[nodiscard]] virtual std::vector<std::string> warnings() const { return {}; }
    /// Width of a pixel over its height.
    [[nodiscard]] virtual double pixel_aspect() const { return 1; }
    /// The frame whose picture read() returns; differs from `frame` if another one is held in place
    /// of a missing one.
    [[nodiscard]] virtual int shown_frame(int frame) const { return frame; }
};

/// Opens a pattern (a folder with exactly one numbered sequence counts as one), a movie file or a
/// single picture (a plate of one frame). A photograph is rotated upright by its Orientation tag.
/// An EXR frame is its display window, 0 where it has no data. A movie is decoded once to count its
/// frames, because containers are not reliable. Errors: MissingFrames if a pattern matches no file,
/// Unreadable for a movie without frames or a file that is neither, Usage if a folder holds several
/// sequences (the message lists them) or the pattern has two numbers.
[[nodiscard]] Expected<std::shared_ptr<const FrameReader>> open_plate(const std::string& path,
                                                                      const ReadOptions& options);

}  // namespace weft

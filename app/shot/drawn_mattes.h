#pragma once
// Mattes that are drawn from roto shapes over time.

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "app/project/project.h"
#include "engine/core/error.h"
#include "engine/core/hash.h"
#include "engine/core/image.h"
#include "engine/core/pixel_aspect.h"
#include "engine/media/frame_reader.h"
#include "engine/motion/corner_track.h"

namespace weft {

/// Shapes of a shot on its frames. Each track is read once. Paths are absolute. Thread-safe.
class DrawnMattes {
  public:
    /// Of the plate: its size, its first frame and the shape of its pixels.
    DrawnMattes(Size size, int first_frame, PixelAspect aspect = {})
        : size_(size), first_frame_(first_frame), aspect_(aspect) {}

    /// Errors: Unreadable (the track), Usage (it follows, but has no track).
    [[nodiscard]] Expected<RotoShape> shape(const KeyedShape& shape, int frame) const;
    /// The same without waiting and without reading a file: none until its track has been read.
    [[nodiscard]] std::optional<RotoShape> known_shape(const KeyedShape& shape, int frame) const;
    /// The shape's inside, or with `invert` its outside.
    [[nodiscard]] Expected<Matte> matte(const KeyedShape& shape, bool invert, int frame) const;

  private:
    [[nodiscard]] Expected<std::shared_ptr<const CornerTrack>> track_of(
        const KeyedShape& shape) const;

    Size size_;
    int first_frame_;
    PixelAspect aspect_;
    mutable std::mutex mutex_;
    mutable std::map<std::string, std::shared_ptr<const CornerTrack>> tracks_;
};

/// All that a shape says, apart from what its track's file holds.
void add_shape(Hasher& hasher, const KeyedShape& shape);

/// Whether every shape of the region can be drawn: a track that is missing or cannot be read is
/// said before any work. Errors: those of DrawnMattes::shape().
[[nodiscard]] Status check_shapes(const Region& region, const FrameReader& plate);

}  // namespace weft

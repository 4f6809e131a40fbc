#pragma once
// Internal: whether a movie's frames hold two moments in time.

#include "engine/media/field_order.h"
#include "engine/media/video_library.h"

namespace weft {

/// Looks at some of a movie's frames. Not thread-safe.
class MovieFields {
  public:
    /// The next frame in the order in which they are shown.
    void add(const AVFrame& frame);
    /// The frames show two moments each, whether they are flagged so or not.
    [[nodiscard]] bool are_interlaced() const;
    /// A frame is flagged as interlaced.
    [[nodiscard]] bool are_flagged() const { return flagged_; }

  private:
    FieldMeter meter_;
    int frames_ = 0;
    bool flagged_ = false;
};

}  // namespace weft

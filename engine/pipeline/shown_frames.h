#pragma once
// Internal to sweep(): frames between which a surface can be followed.

#include <functional>
#include <memory>

#include "engine/core/error.h"
#include "engine/pipeline/frame_look.h"
#include "engine/pipeline/plate_views.h"

namespace weft {

/// A frame that is black, burnt out, of one colour, or of another scene for no more than three
/// frames (a flash, a wrong frame) shows nothing of a surface. For such a frame the one that was
/// seen before it, in the order of the sweep, is given again, so that nothing moves on the way
/// there, and the next one is followed from that. At the beginning it is the first that shows
/// something. Not thread-safe.
class ShownFrames {
  public:
    struct Seen {
        int frame = 0;
        std::shared_ptr<const PlateViews> views;
        bool cut = false;  ///< Of another scene than what was seen before.
    };
    /// The views of the frame that lies so many frames ahead in the sweep; null: the sweep ends
    /// before it.
    using Peek = std::function<Expected<Seen>(int ahead)>;

    /// What is seen on the next frame of the sweep. Errors: those of `peek`.
    [[nodiscard]] Expected<Seen> next(Seen frame, const Peek& peek);

  private:
    [[nodiscard]] Expected<Seen> begin(Seen frame, const Peek& peek);
    [[nodiscard]] Expected<bool> is_brief(const Peek& peek) const;

    Seen seen_;
    FrameLook look_;      // of it
    float usual_ = 0;     // the largest spread so far
    int seen_ahead_ = 0;  // frames until the one that was seen ahead
};

/// True if motion between two frames can be told from them alone: both show something, of one
/// scene.
[[nodiscard]] bool are_neighbours(const PlateViews& a, const PlateViews& b);

}  // namespace weft

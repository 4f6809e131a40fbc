#pragma once
// Internal: whether the two fields of a movie's frames were taken at two moments, by the pictures
// and not by flags: progressive pictures are often carried in interlaced streams (PsF), and the
// other way round.

#include <cstdint>

#include "engine/core/image.h"

namespace weft {

enum class Fields {
    kUnknown,      ///< Nothing moves enough, or nothing that tells.
    kProgressive,  ///< Both fields of each frame show one moment.
    kInterlaced,   ///< Two, in some of the frames: of telecine in two of five.
};

/// What one frame says, with the frame before.
enum class FieldVote { kNone, kProgressive, kUpperFirst, kLowerFirst };

/// Looks at frames in the order in which they are shown. In a progressive movie the upper field of
/// a frame is as far in time from the lower field of the frame before as the lower one is from the
/// upper field of the frame before. In an interlaced one these times are 1 and 3 half frames, or 3
/// and 1. Distances in time show as differences between a field and the other one, interpolated.
///
/// A field shows a hard horizontal edge to two lines only, so one that moves by two lines a frame
/// fits either: its frames are the same pictures. Where a movie is not flagged as interlaced, such
/// edges do not count: what counts is lines that part (combing) or repeat within a frame.
class FieldMeter {
  public:
    /// The next frame. `luma`: all of its lines, at least 8, in 8 bits; columns may be left out.
    void add(Matte luma);
    /// The next frame to be added does not follow the last one.
    void skip() { before_ = {}; }
    /// `flagged`: the movie says that it is interlaced, and is believed where pictures fit either.
    [[nodiscard]] Fields fields(bool flagged) const;

  private:
    struct Votes {
        int progressive = 0, upper_first = 0, lower_first = 0;  // frames
        void add(FieldVote vote);
    };
    /// A frame, and which of its pixels lie in calm columns; see calm_pixels().
    struct Frame {
        Matte luma, calm;
    };
    void count(const Frame& now);

    Frame before_;
    Votes all_, parted_;  ///< By all lines; the same, two moments only where lines part, too.
};

}  // namespace weft

#pragma once
// Internal: whether the two fields of a movie's frames were taken at two moments, by the pictures
// and not by flags: progressive pictures are often carried in interlaced streams (PsF), and the
// other way round.

#include <array>
#include <cstdint>
#include <vector>

#include "engine/core/image.h"

namespace weft {

enum class Fields {
    kUnknown,      ///< Nothing moves enough.
    kProgressive,  ///< Both fields of each frame show one moment.
    kInterlaced,   ///< Two, in some of the frames: of telecine in two of five.
};

/// Looks at frames in the order in which they are shown. In a progressive movie the upper field of
/// a frame is as far in time from the lower field of the frame before as the lower one is from the
/// upper field of the frame before. In an interlaced one these times are 1 and 3 half frames, or 3
/// and 1. Distances in time show as differences between a field and the other one, interpolated.
class FieldMeter {
  public:
    /// The next frame. `luma`: all of its lines, at least 8, in 8 bits; columns may be left out.
    void add(Matte luma);
    /// The next frame to be added does not follow the last one.
    void skip() { before_ = {}; }
    /// `least_share`: of the frames that tell, above which two moments are no accident. Telecine
    /// has two of five, cuts and dissolves make single ones.
    [[nodiscard]] Fields fields(double least_share) const;

  private:
    Matte before_;
    int progressive_ = 0, upper_first_ = 0, lower_first_ = 0;  // frames
};

}  // namespace weft

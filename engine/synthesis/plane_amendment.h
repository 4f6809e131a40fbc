#pragma once
// What an artist has decided about places of a grown plane: to be kept as it is, or made again.

#include <cstdint>
#include <vector>

namespace weft {

/// Neighbouring texels of a row of a plane, and what they show.
struct TexelRun {
    int x = 0, y = 0, count = 1;
    int from_x = 0, from_y = 0;  ///< Of the first: pixel of the sample as it was given.
    int sample = 0;              ///< Which of several.
    int orientation = 0;         ///< As in SampleAtlas::Page. Not 0: `count` is 1.
    bool operator==(const TexelRun&) const = default;
};

struct PlaneAmendment {
    enum class Kind : std::uint8_t {
        kKeep,  ///< These texels show what the runs say, whatever else changes.
        kAgain  ///< These places are grown once more, with another seed; what the runs show is not
                ///< looked at.
    };
    Kind kind = Kind::kKeep;
    std::uint32_t seed = 0;  ///< Of kAgain: another one gives another result.
    std::vector<TexelRun> runs;
    bool operator==(const PlaneAmendment&) const = default;
};

}  // namespace weft

#pragma once
// An artist's decisions about places of a grown plane: patches to lock or to regenerate.

#include <cstdint>
#include <vector>

namespace weft {

/// Neighbouring texels of a row of a plane, and what they show.
struct TexelRun {
    int x = 0, y = 0, count = 1;
    int from_x = 0, from_y = 0;  ///< Of the first texel: its pixel in the original sample.
    int sample = 0;              ///< Index of the sample, if there are several.
    int orientation = 0;         ///< As in SampleAtlas::Page. Not 0: `count` is 1.
    bool operator==(const TexelRun&) const = default;
};

struct PlaneAmendment {
    enum class Kind : std::uint8_t {
        kKeep,  ///< These texels always show what the runs say.
        kAgain  ///< These places are grown again with another seed; ignores what the runs show.
    };
    Kind kind = Kind::kKeep;
    std::uint32_t seed = 0;  ///< Of kAgain; another seed gives another result.
    std::vector<TexelRun> runs;
    bool operator==(const PlaneAmendment&) const = default;
};

}  // namespace weft

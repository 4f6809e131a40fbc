#pragma once
// What places on a keyframe look like, inside of its matte and outside.

#include <cstdint>
#include <vector>

#include "engine/core/image.h"

namespace weft {

/// How unlike a place is to the likest one of a keyframe on each side, codes per channel in the
/// mean; infinite where there is none.
struct SideMisses {
    float inside, outside;
};

/// The surroundings, three by three, of each cell of a small picture of a keyframe. Thread-safe.
class KeyPatches {
  public:
    /// `lab`: Lab codes by cell; `inside`: the share of each that the matte covers. One size.
    KeyPatches(const ImageU8x3& lab, const ImageF1& inside);

    /// For each of `cells` (row by row) of another picture of the same size: the least miss among
    /// places inside anywhere, and among those outside within `near`. Of many places some are
    /// compared, evenly. Parallel over cells.
    [[nodiscard]] std::vector<SideMisses> misses(const ImageU8x3& lab,
                                                 const std::vector<std::int32_t>& cells,
                                                 const Recti& near) const;

  private:
    ImageU8x3 lab_;
    Image<std::uint8_t, 1> sides_;
};

}  // namespace weft

#pragma once
// Decides between two walks that disagree, over all frames between their keyframes at once.

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/mask/key_patches.h"

namespace weft {

/// A frame as both walks have it; all pictures and mattes are H×W.
struct JointFrame {
    int frame = 0;
    ViewU8x3 picture;        ///< Display codes.
    ViewU8x1 before, after;  ///< The walks' mattes; more than 127 is inside.
    /// What the walk from the later keyframe counts for by pixel, 0–1 (merge_shares()); at 0 and 1
    /// nothing is open, as one walk alone knows. Empty: both mattes are known, as on a keyframe.
    ViewF1 shares;
    ViewU8x1 hidden;  ///< By something in front, where not 0; may be empty.
    /// Where each pixel was on the frame added before this one, px, `valid` where that is reliable;
    /// null: there was none, or a cut lies between.
    const FlowField* last_from_this = nullptr;
};

/// Where two walks disagree, one has leaked or the other has lost something, and a frame by itself
/// does not tell which. Cells of some pixels that they disagree on get a value between outside (0)
/// and inside (1), for all frames at once: cells that move into each other and neighbours of one
/// colour have the same, what both agree on and the keyframes are known, and a cell whose
/// surroundings look like a place inside on a keyframe, and like none outside, is more likely
/// inside. The least sum of squares is a sparse linear system ("random walker": Grady 2006, eq. 5,
/// with links in time). The solution hardly depends on the weights (docs/EVIDENCE.md). Not
/// thread-safe; deterministic.
class JointSides {
  public:
    /// A keyframe's picture and painted matte; before any add().
    void remember(ViewU8x3 picture, ViewU8x1 matte);
    /// The next frame, from one keyframe to the other in either direction of time.
    void add(const JointFrame& in);
    /// After the last add(). Parallel in parts.
    void decide();
    /// 0–1 by pixel: how far a frame's pixels are inside; where nothing was open, the mean of
    /// `before` and `after`, which are as they were added.
    [[nodiscard]] ImageF1 inside(int frame, ViewU8x1 before, ViewU8x1 after) const;

  private:
    // The cells of a frame that are open, row by row; their nodes follow each other.
    struct Open {
        std::size_t first = 0;
        std::vector<std::int32_t> cells;
    };
    struct Link {
        int a, b;
        float weight;
    };
    // What the last frame has by cell.
    struct Cells {
        ImageU8x3 lab;
        ImageF1 inside;
        ImageF1 seen;                 ///< The share that nothing in front hides.
        Image<std::int32_t, 1> node;  ///< −1: known.
        bool any_open = false;
    };

    [[nodiscard]] Cells cells_of(const JointFrame& in, Size grid);
    void add_links(const Cells& cells);
    void add_motion(const JointFrame& in, const Cells& cells);
    void add_likeness(int frame, const Cells& cells);
    void tie(int a, float a_inside, int b, float b_inside, float weight);

    std::vector<KeyPatches> keys_;
    Cells last_;
    std::map<int, Open> open_;  // by frame
    std::vector<Link> links_;
    std::vector<float> pull_, target_;  // by node: weight of what is known, and that times its side
    std::vector<float> inside_;         // by node, once decided
};

}  // namespace weft

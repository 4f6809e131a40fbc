#pragma once
// What has become part of a matte on the way. A surface that turns shows more of itself at its
// edge; but what comes into view beside it can have its colours, too, and is then taken for it.

#include "engine/core/fields.h"
#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

/// Input of Newcomers::advance(). Views of the area (`frame` and the last three) have one size and
/// lie at `area` in the full-size ones.
struct NewcomersInput {
    ViewU8x3 frame;  ///< Display codes.
    ViewU8x3 prev_frame;
    ViewF1 prev_phi;        ///< Signed distance of the boundary on the frame before, pixels.
    const FlowField& flow;  ///< prev_from_cur as measured.
    ViewF2 outside_motion;  ///< prev_from_cur of what surrounds the surface, extended inwards.
    ViewU8x1 appearing;     ///< Not 0: was not seen before (UncoveredParts).
    ViewF1 expected_phi;    ///< As the surface's motion leads, pixels.
    Recti area;             ///< Where it lies in the frame.
    float unit_px;          ///< A pixel of 854×480.
};

/// Knows of every pixel of a matte whether it came from outside, and by whose motion those have
/// gone since: that of the surface that was there from the first, or that of what surrounds it.
/// What went with the surface belongs to it from then on. Not thread-safe.
class Newcomers {
  public:
    /// Goes on by a frame, before its boundary is found. Log odds for inside over the area, below 0
    /// for newcomers that went with their surroundings while the picture shows that the surface did
    /// not, and for what has just come beside them; else 0. Parallel over rows; deterministic.
    [[nodiscard]] ImageF1 advance(const NewcomersInput& in);
    /// The boundary that was found on that frame, of the frame's size.
    void settle(ViewF1 phi);
    /// Of the pixels of that frame that are not 0 here it is known on which side they are.
    void forget(ViewU8x1 where);
    /// 255 where what is inside was clearly outside on an earlier frame, as far as motion can tell,
    /// and in the picture; of the frame's size. Empty before the first frame.
    [[nodiscard]] const Matte& entered() const { return entered_; }

  private:
    void carry(const NewcomersInput& in);
    [[nodiscard]] ImageF1 trusted(const NewcomersInput& in) const;
    [[nodiscard]] Matte thick_parts(const NewcomersInput& in) const;
    void judge(const NewcomersInput& in, const Matte& thick);
    [[nodiscard]] ImageF1 spread(const NewcomersInput& in, const Matte& thick) const;

    Matte entered_;
    Matte doubted_;  ///< 255 where it is not known yet by whose motion a newcomer goes.
    ImageF1 odds_;   ///< For inside, by motion.
};

/// Adds what Newcomers::advance() says to the log odds near the boundary, and what it clearly says
/// to those that reopen a decided part (`wide`). All of one size.
void add_newcomers(const ImageF1& odds, ImageF1& near, ImageF1& wide);

}  // namespace weft

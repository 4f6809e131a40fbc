#pragma once
// What moves otherwise than the background, and what stays with it.

#include <array>
#include <cstddef>

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/mask/surface_palette.h"

namespace weft {

/// A step of the walk. The views of `area` (`frame`, `surface_motion`) have its size, the others
/// the frame's.
struct DepartureInput {
    ViewF1 prev_phi;        ///< Signed distance of the matte's boundary on the frame before, px.
    const FlowField& flow;  ///< prev_from_cur as measured.
    ViewF2 surface_motion;  ///< prev_from_cur of the surface, extended outwards, px.
    ViewU8x3 frame, prev_frame;
    Recti area;         ///< Where the surface may be; empty once it has been lost.
    float unit_px = 1;  ///< A pixel of 854×480.
};

/// Evidence from how far a pixel's motion departs from the background's: from one plane's that is
/// fitted to all that is outside, or from what is near, whichever is nearer, since backgrounds have
/// depth. How often each departure occurs inside and outside is counted on every frame (the naive
/// Bayes of Criminisi et al. 2006, "Bilayer segmentation of live video", with counts in place of
/// training), so a surface that rests on its background, or one that moves as other things around
/// it do, gives no evidence. Motion speaks against what has just come in, such as the ground that a
/// car uncovers, and hardly against what has long been inside and got there by its own motion, such
/// as a foot that rests; against that only where the picture tells both motions apart, since what
/// is plain seems to move as its surroundings do, and then also where the rest of inside and
/// outside move alike, such as an arm in front of a wall. Not thread-safe.
class Departure {
  public:
    /// `key_phi`: signed distance of the painted matte, px.
    explicit Departure(ViewF1 key_phi);

    /// Goes on by a frame. Log odds for inside, H×W, −kMostAgainst to kMostFor. Parallel over rows;
    /// deterministic.
    const ImageF1& advance(const DepartureInput& in);

    /// What the last frame's motion alone says of each pixel, log odds, H×W: whether it departs
    /// from the background's, however far, since a surface that was lost may by now move otherwise.
    /// 0 where the surface has not been told from its background by that.
    [[nodiscard]] const ImageF1& departs() const { return departs_; }

    /// The pixels of the last frame that are not 0 in `where` are known to be inside, or outside,
    /// as `inside` says; what their motion said is forgotten.
    void correct(ViewU8x1 where, ViewU8x1 inside);

    static constexpr float kMostAgainst = 6;
    /// Less than against, because measured motion spreads over edges.
    static constexpr float kMostFor = 1.5f;

  private:
    static constexpr std::size_t kBins = 18;
    using Shares = std::array<float, kBins>;

    struct Step;
    struct Evidence;
    [[nodiscard]] Evidence count(const Step& step);
    [[nodiscard]] float trust() const;
    [[nodiscard]] Shares ratios(const Shares& inside) const;
    [[nodiscard]] float odds_now(const DepartureInput& in, Vec2i at, float departure,
                                 const Evidence& evidence) const;

    ImageF1 age_;             // for how many frames each pixel of the last frame has been inside
    ImageF1 odds_, departs_;  // of the last frame
    Shares inside_{}, outside_{};  // running shares of each departure
    float most_inside_ = 0;        // samples that a frame had inside
    float most_shown_ = 0;         // samples that a frame had inside, whatever their age
};

/// Adds what Departure::advance() says to the log odds near the boundary and to those that reopen a
/// decided part (`wide`), both over `area` as `part` of the frame is. What moves with the
/// background is outside even where the clean plate does not know it, unless its colour is clearly
/// the surface's own.
void add_odds(const ImageF1& departure, const SurfacePalette& palette, ViewU8x3 part,
              const Recti& area, ImageF1& near, ImageF1& wide);

}  // namespace weft

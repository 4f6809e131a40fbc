#pragma once
// Finds again what a registration has lost.

#include <optional>
#include <vector>

#include "engine/temporal/anchors.h"

namespace weft {

/// What a walk goes by.
struct FoundBy {
    bool color = false;  ///< Colours, not luma.
    bool freed = false;  ///< Motion freed of light, as under shades that move.
};

/// Registration reaches a pixel or two. Where a fold or a quick turn made a step miss by more, that
/// part of the surface is lost from then on. It shows: the anchor leaves more unexplained than the
/// noise does, which the walk's own steps tell. Then the surface is looked for around
/// (search_around()), and what was found is taken if the evidence says that it is the same paint,
/// and not a shade that moves over it. Not thread-safe.
class LostPlaces {
  public:
    /// `step`: the fit of the present frame under the step to it from the frame before.
    void note(const RegistrationFit& step);
    /// A better registration than `found`, from a wider search, `by` what the walk goes by; null
    /// where `found` leaves little unexplained, or nothing better was found. After searches in vain
    /// the next frames are not searched.
    [[nodiscard]] std::optional<Registered> find(const Anchor& anchor, const StepFrame& cur,
                                                 FoundBy by, const Registered& found,
                                                 FlowQuality quality);

  private:
    [[nodiscard]] double noise() const;

    std::vector<double> steps_;      // residuals of the last ones
    int in_vain_ = 0, waiting_ = 1;  // searches; frames
};

}  // namespace weft

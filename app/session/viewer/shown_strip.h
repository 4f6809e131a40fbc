#pragma once
// The strip of small results as it is shown: its cards with their pictures.

#include <optional>
#include <string>
#include <vector>

#include "app/preview/playback.h"
#include "app/session/action.h"
#include "app/session/document/document.h"
#include "app/session/document/selection.h"
#include "app/session/session_view.h"
#include "app/session/viewer/preview_desk.h"
#include "app/session/viewer/shown_plate.h"
#include "app/session/viewer/strip.h"

namespace weft {

/// Belongs to one thread and never blocks it.
class ShownStrip {
  public:
    /// The references must stay.
    struct Uses {
        const Document& document;
        const Selection& selection;
        const ShownPlate& plate;
        const Playback& playback;
        PreviewDesk& preview;  ///< Renders the cards.
    };
    explicit ShownStrip(Uses uses) : use_(uses) {}

    void choose_kind(const ShowStrip& wanted) {
        strip_.show(wanted.kind, wanted.textures, wanted.over_time);
    }
    /// Another document was opened.
    void forget() { strip_.show(StripKind::kNone, {}, false); }
    /// What choosing a card does; nothing for the current setting.
    [[nodiscard]] std::optional<Action> choice(int card) const;
    /// Cards for the preview to render.
    [[nodiscard]] std::vector<CardRequest> requests() const;
    /// Cards are being built.
    [[nodiscard]] bool busy() const { return strip_.busy(); }
    /// Requests the cards together with the picture, and sorts finished ones into their order. No
    /// new ones are built while a stroke is painted.
    void update(bool painting, StripView& shown);

  private:
    [[nodiscard]] StripQuery query() const;
    void build(const Region* region);
    [[nodiscard]] StripCard card(const CardRequest& request) const;

    Uses use_;
    Strip strip_;
};

}  // namespace weft

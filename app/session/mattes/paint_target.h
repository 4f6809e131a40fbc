#pragma once
// What a stroke or a tool changes: the matte of the selected layer on the playhead's frame.

#include <optional>

#include "app/mattes/matte_painting.h"
#include "app/mattes/matte_shelf.h"
#include "app/preview/playback.h"
#include "app/session/document/document.h"
#include "app/session/document/notices.h"
#include "app/session/document/selection.h"
#include "app/session/mattes/shown_mattes.h"
#include "app/session/viewer/shown_plate.h"

namespace weft {

/// A matte on a frame to which it is propagated, and what is confirmed of it.
struct ConfirmedMatte {
    MattePtr matte;  ///< Of the whole frame, as it is shown.
    MattePtr area;   ///< What is confirmed of it.
};

/// Says with a notice why something cannot be changed.
class PaintTarget {
  public:
    /// The references must stay.
    struct Uses {
        const Document& document;
        const Selection& selection;
        const ShownPlate& plate;
        const Playback& playback;
        ShownMattes& shown;
        Notices& notices;
    };
    explicit PaintTarget(Uses uses) : use_(uses) {}

    /// Null: no region is selected.
    [[nodiscard]] const Region* region() const {
        return use_.selection.of(use_.document.project());
    }
    /// The layer; with a region only.
    [[nodiscard]] const MatteSource& source() const;
    [[nodiscard]] MattePlace place() const {
        return {use_.selection.region, use_.selection.layer, use_.playback.frame()};
    }
    [[nodiscard]] Size size() const { return use_.plate.reader()->size(); }
    /// It stands still, and can be painted as far as is known without a word.
    [[nodiscard]] bool is_ready() const;
    /// `busy`: its matte is being changed in the background.
    [[nodiscard]] bool may_paint(bool busy) const;
    /// As it is shown; its `keep` is null while it is read.
    [[nodiscard]] RegionMatteView shown() const {
        return use_.shown.matte_of(*region(), use_.selection.layer);
    }
    /// Null: an empty matte. Nothing: not loaded yet.
    [[nodiscard]] std::optional<MattePtr> matte() const;

    // ---- confirmed parts ----
    /// A change here counts where it is made only: not on a keyframe, where all of the matte
    /// counts.
    [[nodiscard]] bool counts_in_part(bool here_only) const;
    /// On a keyframe or a frozen frame all of the matte counts.
    [[nodiscard]] bool counts_as_whole() const;
    /// What a change of a part begins with; nothing if it cannot begin.
    [[nodiscard]] std::optional<ConfirmedMatte> confirmed() const;

  private:
    Uses use_;
};

}  // namespace weft

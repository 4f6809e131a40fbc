#pragma once
// Brush strokes on mattes, and on what is confirmed of them.

#include <optional>

#include "app/mattes/matte_painting.h"
#include "app/preview/playback.h"
#include "app/session/action.h"
#include "app/session/document/document.h"
#include "app/session/document/notices.h"
#include "app/session/mattes/kept_mattes.h"
#include "app/session/mattes/matte_changes.h"
#include "app/session/mattes/paint_target.h"
#include "app/session/session_view.h"

namespace weft {

/// Belongs to one thread and never blocks it.
class MatteStrokes {
  public:
    /// The references must stay.
    struct Uses {
        const Document& document;
        Playback& playback;  ///< Stops when a stroke begins.
        const PaintTarget& target;
        MattePainting& painting;
        KeptMattes& kept;
        MatteChanges& changes;  ///< Those before a stroke are made first.
        Notices& notices;
    };
    explicit MatteStrokes(Uses uses) : use_(uses) {}

    /// Ends the stroke before.
    void begin(const BeginStroke& action);
    void go_on(const ContinueStroke& action) { use_.painting.move_to(action.at, action.pressure); }
    /// Keeps what was painted, if anything was; a stroke that still waits for its matte is one of
    /// the changes from then on.
    void end();
    /// Begins to paint a stroke that waited for its matte. Call it in every update.
    void update();
    /// Prepares a stroke at the playhead from the mattes that are shown.
    void prepare(const SessionView& shown);

  private:
    [[nodiscard]] bool may_confirm() const;
    [[nodiscard]] ChangeLabels labels(const MattePlace& place) const;

    Uses use_;
    Counts counts_ = Counts::kAll;        // of the stroke
    std::optional<ConfirmedMatte> part_;  // as PaintBase::part
};

}  // namespace weft

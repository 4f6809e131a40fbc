#pragma once
// Brush strokes on mattes, and on what is confirmed of them.

#include <optional>

#include "app/mattes/matte_painting.h"
#include "app/preview/playback.h"
#include "app/session/action.h"
#include "app/session/document/document.h"
#include "app/session/document/notices.h"
#include "app/session/mattes/kept_mattes.h"
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
        Notices& notices;
    };
    explicit MatteStrokes(Uses uses) : use_(uses) {}

    /// Ends the stroke before. `busy`: the matte is being changed in the background.
    void begin(const BeginStroke& action, bool busy);
    void go_on(const ContinueStroke& action) { use_.painting.move_to(action.at, action.pressure); }
    /// Keeps what was painted, if anything was.
    void end();
    /// Prepares a stroke at the playhead from the mattes that are shown.
    void prepare(const SessionView& shown);

  private:
    void begin_painting(const BeginStroke& action);
    void begin_confirming(const BeginStroke& action);

    Uses use_;
    std::optional<ConfirmedMatte> before_;  // the stroke, if it counts in part only
};

}  // namespace weft

#pragma once
// The measurement of a result: one at a time, in a thread of its own.

#include <memory>
#include <string>

#include "app/preview/preview.h"
#include "app/session/document/document.h"
#include "app/session/document/notices.h"
#include "app/session/document/selection.h"
#include "app/session/document/shutdowns.h"
#include "app/session/session_view.h"
#include "app/session/viewer/shown_plate.h"

namespace weft {

/// Belongs to one thread and never blocks it, except for the destructor.
class Measurement {
  public:
    /// The references must stay.
    struct Uses {
        const Document& document;
        const Selection& selection;
        const ShownPlate& plate;
        const Preview& preview;  ///< Has propagated mattes and tracks.
        Notices& notices;
        Shutdowns& shutdowns;
    };
    explicit Measurement(Uses uses) : use_(uses) {}

    /// Measures the frames of `pattern` where the selected region is; ends the measurement before.
    void start(const std::string& pattern);
    /// Ends it in the background, because it may be reading a large frame.
    void end();
    /// As of the last show().
    [[nodiscard]] bool busy() const { return busy_; }
    /// Writes the report, if something is or was measured.
    void show(SessionView& view);

  private:
    struct Running;

    Uses use_;
    std::shared_ptr<Running> running_;
    bool busy_ = false;
};

}  // namespace weft

#pragma once
#include "app/preview/playback.h"
#include "app/session/action.h"
#include "app/session/document/document.h"
#include "app/session/document/document_tasks.h"
#include "app/session/document/notices.h"
#include "app/session/document/selection.h"
#include "app/session/viewer/shown_plate.h"

namespace weft {

/// Picks objects of a Cryptomatte for the selected layer. Belongs to one thread and never blocks
/// it.
class CryptomattePick {
  public:
    /// The references must stay.
    struct Uses {
        Document& document;
        const Selection& selection;
        const ShownPlate& plate;
        const Playback& playback;
        DocumentTasks& tasks;
        Notices& notices;
    };
    explicit CryptomattePick(Uses uses) : use_(uses) {}

    void pick(const PickCryptomatte& action);

  private:
    void take(const std::string& object, bool subtract, RegionId region, int layer);

    Uses use_;
};

}  // namespace weft

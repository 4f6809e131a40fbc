#pragma once
// Layers whose mattes are drawn from a shape over time, and keyframes that were drawn as shapes.

#include "app/preview/playback.h"
#include "app/preview/preview.h"
#include "app/session/action.h"
#include "app/session/document/document.h"
#include "app/session/document/document_tasks.h"
#include "app/session/document/notices.h"
#include "app/session/document/selection.h"
#include "app/session/mattes/kept_mattes.h"
#include "app/session/mattes/matte_folder.h"
#include "app/session/session_view.h"
#include "app/session/viewer/shown_plate.h"

namespace weft {

/// Belongs to one thread and never blocks it.
class MatteShapes {
  public:
    /// The references must stay.
    struct Uses {
        const Document& document;
        const Selection& selection;
        const ShownPlate& plate;
        const Playback& playback;
        const Preview& preview;  ///< Knows the motion of the surface.
        MatteFolder& folder;
        KeptMattes& kept;
        DocumentTasks& tasks;
        Notices& notices;
    };
    explicit MatteShapes(Uses uses) : use_(uses) {}

    /// From now on the selected layer is drawn from its shape.
    void follow(const FollowShape& action);
    /// Its shapes become painted keyframes.
    void detach();
    void show(SessionView& view) const;

  private:
    void track(const FollowShape& action, const RotoShape& shape, int frame);
    [[nodiscard]] const Region* region() const {
        return use_.selection.of(use_.document.project());
    }

    Uses use_;
};

}  // namespace weft

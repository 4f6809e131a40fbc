#pragma once
// What the timeline says of each frame.

#include <vector>

#include "app/preview/plate_player.h"
#include "app/preview/preview.h"
#include "app/session/session_view.h"
#include "app/session/where_to_correct.h"

namespace weft {

/// Sets the marks of the plate's frames, for the selected region and its painted layer as `view`
/// has them. `plate`: by index into the frames, as far as known.
void show_marks(const std::vector<PlatePlayer::State>& plate, const PreviewReading& preview,
                SessionView& view);
/// Where the selected region's matte and texture are best corrected, from the marks of `view`.
[[nodiscard]] std::vector<CorrectionHint> suggested_corrections(const SessionView& view);

}  // namespace weft

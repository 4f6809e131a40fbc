#include "app/editor/run_modes.h"

namespace weft {

Expected<int> run_offscreen(const EditorOptions&) {
    return fail(ErrorCode::kUsage,
                "This build cannot draw without a display: EGL's headers (libegl-dev) were missing "
                "when it was made.");
}

}  // namespace weft

#pragma once
// Finds the rest of a surface again of which a part was lost, as behind a post.

#include "engine/core/image.h"
#include "engine/mask/motion_evidence.h"

namespace weft {

/// What departs from the background's motion as a surface does, in its colours and joined to what
/// is left of it, is the surface as far as that makes it as large as it was. MotionReturn looks for
/// one that is lost altogether. Not thread-safe.
class PartReturn {
  public:
    /// `key_phi`: signed distance of the painted matte, px.
    explicit PartReturn(ViewF1 key_phi);

    /// What is to be added, 255 or 0, once a large part has been lost and the rest has been there
    /// on three frames in a row; else empty. Deterministic.
    [[nodiscard]] Matte returned(const MotionReturnInput& in);

  private:
    double usual_px_;  // the surface's area while all of it was seen
    int frames_ = 0;   // for which the rest has been there
};

}  // namespace weft

#include "engine/compute/backend.h"

namespace weft {

std::unique_ptr<PlaneSearch> Backend::open_plane_search(const PlaneSearchSetup&) const {
    return nullptr;
}

std::unique_ptr<FrameCanvas> Backend::open_frame(ViewF3) const {
    return nullptr;
}

}  // namespace weft

#pragma once
// Where the heavy operations run. The scalar CPU code is the reference; every other backend gives
// the same integers and pixels within 1/255.

#include <memory>
#include <string>
#include <vector>

#include "engine/compute/frame_canvas.h"
#include "engine/compute/plane_search.h"
#include "engine/core/image.h"

namespace weft {

/// Operations on plain descriptors. Thread-safe: one backend serves many frames at a time.
class Backend {
  public:
    virtual ~Backend() = default;
    [[nodiscard]] virtual std::string name() const = 0;         ///< As in --backend.
    [[nodiscard]] virtual std::string description() const = 0;  ///< Device, for the report.
    /// Events for the report, such as a fallback to the CPU; each one once.
    [[nodiscard]] virtual std::vector<std::string> remarks() const { return {}; }

    /// `out`: H×W×3, in the pyramid's space; pixels with matte 0 are left as they are.
    virtual void sample_plane(const SampleRequest& request, ImageView<float, 3> out) const = 0;

    /// A search that keeps the plane on the backend's device. Null if there is none faster than the
    /// CPU's own (engine/synthesis), or it does not fit; remarks() gives the reason.
    [[nodiscard]] virtual std::unique_ptr<PlaneSearch> open_plane_search(
        const PlaneSearchSetup& setup) const;
    /// A frame on the backend's device, in linear light. Null if the frame must be composited on
    /// the CPU (engine/lighting, engine/composite); remarks() gives the reason.
    [[nodiscard]] virtual std::unique_ptr<FrameCanvas> open_frame(ViewF3 frame) const;
};

}  // namespace weft

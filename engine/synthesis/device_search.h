#pragma once
// A backend's own placement search, shared by the threads that grow a plane.

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/compute/plane_search.h"
#include "engine/synthesis/canvas.h"
#include "engine/synthesis/placement_search.h"
#include "engine/synthesis/sample_atlas.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

/// Searches with the options' backend and keeps its copy of the canvas up to date. If there is no
/// such backend, or it has failed, the caller searches on the CPU with the same result.
/// Thread-safe; searches and updates run one after another.
class DeviceSearch {
  public:
    /// Sends the present contents of the canvas.
    DeviceSearch(const SampleAtlas& atlas, const PlaneOptions& options, const Canvas& canvas);

    [[nodiscard]] bool usable();
    /// Sends the changes of the canvas in `rect`, which on a torus may reach beyond its borders. No
    /// other thread may write there meanwhile.
    void show(const Canvas& canvas, const Recti& rect);
    /// PlacementSearch::find() for a window of the atlas over `block` of the canvas, as of the last
    /// show(). Empty if the device cannot do it.
    [[nodiscard]] std::optional<Shortlist> find(const Recti& block, const Recti& window, Vec2i lo,
                                                Vec2i hi, const std::vector<Vec2i>& forbidden);

  private:
    std::mutex mutex_;
    std::unique_ptr<PlaneSearch> search_;
};

}  // namespace weft

#pragma once
// The placement search of a backend that has one of its own, for a plane that grows by several
// threads.

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

/// Asks the backend of the options, and tells it what the canvas shows. Where there is no such
/// backend, or it has failed, the caller searches by itself: what is found is the same.
/// Thread-safe; searches and updates go one after another.
class DeviceSearch {
  public:
    /// What the canvas holds already is told at once.
    DeviceSearch(const SampleAtlas& atlas, const PlaneOptions& options, const Canvas& canvas);

    [[nodiscard]] bool usable();
    /// Tells that the canvas has changed in `rect`, which on a torus may reach over its borders. No
    /// other thread may write there meanwhile.
    void show(const Canvas& canvas, const Recti& rect);
    /// PlacementSearch::find() for a window of the atlas over `block` of the canvas as it was shown
    /// last. Nothing when the device cannot tell.
    [[nodiscard]] std::optional<Shortlist> find(const Recti& block, const Recti& window, Vec2i lo,
                                                Vec2i hi, const std::vector<Vec2i>& forbidden);

  private:
    std::mutex mutex_;
    std::unique_ptr<PlaneSearch> search_;
};

}  // namespace weft

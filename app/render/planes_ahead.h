#pragma once
// Synthesizes the texture planes of a shot during its analysis.

#include <atomic>
#include <future>
#include <optional>
#include <thread>
#include <vector>

#include "engine/pipeline/region_scene.h"

namespace weft {

/// Owns a thread that synthesizes the planes of all regions in order, or several in parallel if
/// there are many. Not thread-safe.
class PlanesAhead {
  public:
    /// `plan` and `backend` must outlive it.
    PlanesAhead(const ShotPlan& plan, Size plate, const CancelToken& cancel,
                const Backend* backend);
    /// Waits for the thread; planes that are not started are dropped.
    ~PlanesAhead();
    PlanesAhead(const PlanesAhead&) = delete;
    PlanesAhead& operator=(const PlanesAhead&) = delete;

    /// Waits for the region's plane and returns it; nothing if the region has none for the whole
    /// shot. Call it once per region. Errors: those of make_plane().
    [[nodiscard]] Expected<std::optional<RegionPlane>> take(std::size_t region);

  private:
    using Made = Expected<std::optional<RegionPlane>>;
    std::vector<std::promise<Made>> made_;
    std::vector<std::future<Made>> waiting_;
    std::atomic<bool> unwanted_{false};
    std::thread thread_;
};

}  // namespace weft

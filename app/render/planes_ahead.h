#pragma once
// The texture planes of a shot, grown while it is analysed.

#include <atomic>
#include <future>
#include <optional>
#include <thread>
#include <vector>

#include "engine/pipeline/region_scene.h"

namespace weft {

/// Owns a thread that makes the planes of all regions in their order, or several at once where
/// there are many. Not thread-safe.
class PlanesAhead {
  public:
    /// `plan` and `backend` must outlive it.
    PlanesAhead(const ShotPlan& plan, Size plate, const CancelToken& cancel,
                const Backend* backend);
    /// Waits for the thread. What it has not begun yet is left alone.
    ~PlanesAhead();
    PlanesAhead(const PlanesAhead&) = delete;
    PlanesAhead& operator=(const PlanesAhead&) = delete;

    /// The region's plane, waited for; nothing where it has none for the whole shot. Once only for
    /// each region. Errors: those of make_plane().
    [[nodiscard]] Expected<std::optional<RegionPlane>> take(std::size_t region);

  private:
    using Made = Expected<std::optional<RegionPlane>>;
    std::vector<std::promise<Made>> made_;
    std::vector<std::future<Made>> waiting_;
    std::atomic<bool> unwanted_{false};
    std::thread thread_;
};

}  // namespace weft

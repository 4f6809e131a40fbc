#pragma once
#include <memory>
#include <vector>

#include "engine/compute/plane_search.h"
#include "gpu/gpu_backend.h"
#include "gpu/gpu_state.h"

namespace weft {

/// PlaneSearch on a device. A placement costs one copy of the changes, one kernel for the costs
/// (two with a guide), one for the choice, and one wait; the choice is written directly into host
/// memory.
class GpuPlaneSearch final : public PlaneSearch {
  public:
    [[nodiscard]] static Expected<std::unique_ptr<GpuPlaneSearch>> open(
        std::shared_ptr<GpuState> state, SearchStrategy strategy, const PlaneSearchSetup& setup);
    ~GpuPlaneSearch() override;

    Status update(const Recti& rect, ViewU8x3 pixels, ViewU8x1 filled) override;
    Expected<PlaneSearchResult> find(const PlaneSearchRequest& request) override;

  private:
    struct Sample {
        Size size;
        DeviceBuffer pixels, squares;
    };

    GpuPlaneSearch(std::shared_ptr<GpuState> state, SearchStrategy strategy)
        : state_(std::move(state)), strategy_(strategy) {}
    Status prepare(const PlaneSearchSetup& setup);
    Status add_sample(ViewU8x3 sample);
    Status upload(const Recti& rect, ViewU8x3 pixels, ViewU8x1 takes_part, DeviceBuffer& to);
    [[nodiscard]] Expected<std::size_t> stage(std::size_t bytes);
    Status check(const PlaneSearchRequest& request) const;
    Status search(const PlaneSearchRequest& request, PlaneSearchResult& result);
    Status compare(const PlaneSearchRequest& request);
    Status select(const PlaneSearchRequest& request, bool some_forbidden);
    Status flush();
    Status wait();
    template <class T>
    Expected<T> noted(Expected<T> result);

    std::shared_ptr<GpuState> state_;
    SearchStrategy strategy_;
    Size canvas_size_;
    bool torus_ = false, broken_ = false;
    std::uint32_t fill_weight_ = 1, guide_weight_ = 0;
    DeviceQueue queue_;
    DeviceBuffer canvas_, guide_, costs_;
    std::vector<Sample> samples_;
    PinnedBuffer staging_;  ///< What was changed, until it has been copied.
    std::size_t staged_bytes_ = 0;
    std::vector<CopyRows> pending_;  ///< From there; queued by the next search.
    PinnedBuffer allowed_, found_;
};

}  // namespace weft

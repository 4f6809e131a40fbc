#pragma once
#include <memory>
#include <vector>

#include "engine/compute/frame_canvas.h"
#include "gpu/gpu_state.h"

namespace weft {

/// Backend::sample_plane() on the device.
[[nodiscard]] Status sample_plane_on(GpuState& state, const SampleRequest& request,
                                     ImageView<float, 3> out);

/// FrameCanvas on a device.
class GpuFrame final : public FrameCanvas {
  public:
    [[nodiscard]] static Expected<std::unique_ptr<GpuFrame>> open(std::shared_ptr<GpuState> state,
                                                                  ViewF3 frame);
    ~GpuFrame() override;

    Status add(const LayerRequest& layer) override;
    Status read(const Recti& rect, ImageView<float, 3> out) override;
    Expected<std::int64_t> finish(std::optional<float> knee, ImageView<float, 3> out) override;

  private:
    GpuFrame(std::shared_ptr<GpuState> state, Size size, std::unique_ptr<FramePlace> place)
        : state_(std::move(state)), size_(size), place_(std::move(place)) {}
    Status upload(ViewF3 frame);
    Status check(const LayerRequest& layer) const;
    Status add_layer(const LayerRequest& layer);
    Status roll_off(float knee);
    Status complete(std::optional<float> knee);
    /// Brings the box into the layer staging, the frame first and then the union of the mattes.
    Status download(const Recti& rect, bool with_touched);
    Status noted(Status status);

    std::shared_ptr<GpuState> state_;
    Size size_;
    std::unique_ptr<FramePlace> place_;
    std::vector<std::shared_ptr<const DevicePlane>> planes_;  ///< In use until the queue is empty.
    Recti touched_;
    std::uint64_t exceeded_ = 0;
    bool broken_ = false;
};

}  // namespace weft

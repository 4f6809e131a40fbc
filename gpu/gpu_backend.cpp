#include "gpu/gpu_backend.h"

#include "engine/compute/plane_sampler.h"
#include "gpu/gpu_frame.h"
#include "gpu/gpu_plane_search.h"
#include "gpu/gpu_state.h"

namespace weft {
namespace {

std::size_t plane_bytes(const Device& device, const GpuBackendOptions& options) {
    return options.plane_bytes > 0 ? options.plane_bytes : device.total_bytes() / 4;
}

}  // namespace

GpuBackend::GpuBackend(std::shared_ptr<Device> device, GpuBackendOptions options)
    : options_(std::move(options)),
      state_(std::make_shared<GpuState>(device, plane_bytes(*device, options_))) {}

std::string GpuBackend::description() const {
    return state_->device()->description();
}

std::vector<std::string> GpuBackend::remarks() const {
    return state_->remarks();
}

void GpuBackend::sample_plane(const SampleRequest& request, ImageView<float, 3> out) const {
    if (!state_->lost()) {
        const Status status = sample_plane_on(*state_, request, out);
        if (status) return;
        state_->note(status.error(), "The CPU sampled the texture instead.");
    }
    sample_plane_cpu(request, out);
}

std::unique_ptr<PlaneSearch> GpuBackend::open_plane_search(const PlaneSearchSetup& setup) const {
    if (state_->lost()) return nullptr;
    auto search = GpuPlaneSearch::open(state_, options_.strategy, setup);
    if (search) return std::move(*search);
    state_->note(search.error(), "The CPU searched for placements instead.");
    return nullptr;
}

std::unique_ptr<FrameCanvas> GpuBackend::open_frame(ViewF3 frame) const {
    if (state_->lost()) return nullptr;
    auto canvas = GpuFrame::open(state_, frame);
    if (canvas) return std::move(*canvas);
    state_->note(canvas.error(), "The CPU composited the frame instead.");
    return nullptr;
}

}  // namespace weft

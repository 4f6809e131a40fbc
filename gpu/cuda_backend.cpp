#include "gpu/cuda_backend.h"

#include "gpu/cuda_device.h"
#include "gpu/gpu_backend.h"

namespace weft {
namespace {

BackendEntry entry(const std::string& name, int score, SearchStrategy strategy) {
    return {
        name, score, [=]() -> Expected<std::shared_ptr<const Backend>> {
            WEFT_TRY(device, open_cuda_device());
            return std::make_shared<const GpuBackend>(device, GpuBackendOptions{name, strategy, 0});
        }};
}

}  // namespace

void register_cuda(BackendRegistry& registry) {
    registry.add(entry("cuda", 100, SearchStrategy::kTiled));
    // The paper's strategies, to compare with. `auto` stops at the CPU before it comes to them.
    registry.add(entry("cuda-candidate", -1, SearchStrategy::kCandidate));
    registry.add(entry("cuda-pixel", -2, SearchStrategy::kPixel));
}

}  // namespace weft

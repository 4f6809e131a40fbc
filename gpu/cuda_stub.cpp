// Built where there is no nvcc, or where CUDA is not wanted.
#include "gpu/cuda_device.h"

namespace weft {

Expected<std::shared_ptr<Device>> open_cuda_device() {
    return fail(
        ErrorCode::kNoBackend,
        "CUDA cannot be used here: this build does not include CUDA (nvcc was not found, or "
        "WEFT_CUDA is OFF).");
}

}  // namespace weft

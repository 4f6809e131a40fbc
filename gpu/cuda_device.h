#pragma once
#include <memory>

#include "gpu/device.h"

namespace weft {

/// The first CUDA device. Errors: NoBackend, with the reason: no CUDA in this build, no driver, no
/// device, or one that this build has no code for.
[[nodiscard]] Expected<std::shared_ptr<Device>> open_cuda_device();

}  // namespace weft

// Built where there is no nvcc.
#include "gpu/cuda_probe.h"

namespace weft {

CudaProbe probe_cuda() { return {false, 0, "this build was made without CUDA (nvcc was not found)"}; }

}  // namespace weft

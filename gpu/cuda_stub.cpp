// Built where there is no nvcc, or where CUDA is not wanted.
#include "gpu/cuda_probe.h"

namespace weft {

CudaProbe probe_cuda() {
    return {false, 0, "this build has no CUDA in it (nvcc was not found, or WEFT_CUDA is OFF)"};
}

}  // namespace weft

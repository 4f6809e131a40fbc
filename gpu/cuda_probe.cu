#include <cuda_runtime.h>

#include "gpu/cuda_probe.h"

namespace weft {

CudaProbe probe_cuda() {
    CudaProbe probe;
    probe.compiled = true;
    const cudaError_t error = cudaGetDeviceCount(&probe.devices);
    if (error != cudaSuccess || probe.devices == 0) {
        probe.devices = 0;
        probe.detail = error != cudaSuccess ? cudaGetErrorString(error) : "no CUDA device was found";
        return probe;
    }
    cudaDeviceProp properties;
    const bool known = cudaGetDeviceProperties(&properties, 0) == cudaSuccess;
    probe.detail = known ? properties.name : "a CUDA device";
    return probe;
}

}  // namespace weft

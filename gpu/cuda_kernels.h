#pragma once
// The one door between the code that nvcc compiles and the rest. What is returned is a cudaError_t.

#include "gpu/kernels/catalogue.h"

namespace weft {

/// Makes sure that the device has code for every kernel.
int load_cuda_kernels();

/// Starts a kernel on a CUDA stream; `args` is the kernel's Args.
int launch_cuda_kernel(kernels::KernelId id, int blocks, const void* args, void* stream);

}  // namespace weft

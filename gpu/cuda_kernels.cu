#include <cuda_runtime.h>

#include "gpu/cuda_kernels.h"

namespace weft {
namespace {

// The thread block that this code runs in.
class ThisBlock {
  public:
    template <class T>
    struct Local {
        T value;
        WEFT_HD T& operator[](int) { return value; }
    };

    WEFT_HD int index() const {
#ifdef __CUDA_ARCH__
        return static_cast<int>(blockIdx.x);
#else
        return 0;
#endif
    }
    template <class T>
    WEFT_HD Local<T> local() const {
        return {};
    }
    template <class F>
    WEFT_HD void each(F f) const {
#ifdef __CUDA_ARCH__
        f(static_cast<int>(threadIdx.x));
        __syncthreads();
#else
        f(0);
#endif
    }
};

template <class K>
__global__ void __launch_bounds__(K::kThreads)
    run_kernel(const __grid_constant__ typename K::Args args) {
    __shared__ typename K::Shared shared;
    ThisBlock block;
    K::run(block, shared, args);
}

}  // namespace

int load_cuda_kernels() {
    for (int id = 0; id < kernels::kKernelCount; ++id) {
        const int code = kernels::with_kernel(static_cast<kernels::KernelId>(id), [](auto tag) {
            cudaFuncAttributes attributes{};
            return static_cast<int>(
                cudaFuncGetAttributes(&attributes, run_kernel<typename decltype(tag)::Kernel>));
        });
        if (code != cudaSuccess) return code;
    }
    return cudaSuccess;
}

int launch_cuda_kernel(kernels::KernelId id, int blocks, const void* args, void* stream) {
    return kernels::with_kernel(id, [&](auto tag) -> int {
        using K = typename decltype(tag)::Kernel;
        if (blocks <= 0) return cudaSuccess;
        run_kernel<K>
            <<<static_cast<unsigned>(blocks), K::kThreads, 0, static_cast<cudaStream_t>(stream)>>>(
                *static_cast<const typename K::Args*>(args));
        return cudaGetLastError();
    });
}

}  // namespace weft

#include "gpu/cuda_backend.h"

#include "gpu/cuda_probe.h"

namespace weft {
namespace {

Expected<std::shared_ptr<const Backend>> make_cuda() {
    const CudaProbe probe = probe_cuda();
    if (probe.devices == 0) {
        return fail(ErrorCode::kNoBackend, "CUDA cannot be used here: " + probe.detail + ".");
    }
    return fail(ErrorCode::kNoBackend,
                "CUDA cannot be used yet: " + probe.detail +
                    " is there, but this version of Weft has no CUDA kernels.");
}

}  // namespace

void register_cuda(BackendRegistry& registry) {
    registry.add({"cuda", 100, make_cuda});
}

}  // namespace weft

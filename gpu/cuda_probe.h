#pragma once
#include <string>

namespace weft {

/// What the CUDA runtime finds here.
struct CudaProbe {
    bool compiled = false;  ///< This build has CUDA in it.
    int devices = 0;
    std::string detail;  ///< The first device's name, or why there is none.
};

/// Asks the runtime; never fails and never needs a driver.
[[nodiscard]] CudaProbe probe_cuda();

}  // namespace weft

#pragma once
#include "engine/compute/backend_registry.h"

namespace weft {

/// Adds "cuda" to the registry. Making it says what is missing on this machine, if anything is.
void register_cuda(BackendRegistry& registry);

}  // namespace weft

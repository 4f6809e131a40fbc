#pragma once
#include "engine/compute/backend_registry.h"

namespace weft {

/// Adds "cuda" to the registry, and "cuda-candidate" and "cuda-pixel", which use other strategies
/// for the placement search and which `auto` never takes. Creating one fails with the reason if
/// this machine lacks something.
void register_cuda(BackendRegistry& registry);

}  // namespace weft

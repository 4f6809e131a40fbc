#pragma once
#include "engine/compute/backend_registry.h"

namespace weft {

/// Adds "cuda" to the registry, and "cuda-candidate" and "cuda-pixel", which differ in how they
/// search for placements and which `auto` never takes. Making one says what is missing on this
/// machine, if anything is.
void register_cuda(BackendRegistry& registry);

}  // namespace weft

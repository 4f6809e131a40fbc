#pragma once
#include <string>

#include "app/render/render_job.h"
#include "engine/core/error.h"

namespace weft {

/// Applies `--threads` and `--isa` to the process and opens the backend, for tools that synthesize
/// planes. Errors: NoBackend when this machine does not have it.
[[nodiscard]] Expected<BackendChoice> choose_engine(int threads, const std::string& isa,
                                                    const std::string& backend);

}  // namespace weft

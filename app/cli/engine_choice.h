#pragma once
#include <string>

#include "app/render/render_job.h"
#include "engine/core/error.h"

namespace weft {

/// What `--threads`, `--isa` and `--backend` ask of the tools that grow planes: sets the first two
/// for the process and opens the third. Errors: NoBackend when this machine has not got it.
[[nodiscard]] Expected<BackendChoice> choose_engine(int threads, const std::string& isa,
                                                    const std::string& backend);

}  // namespace weft

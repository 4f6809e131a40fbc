#pragma once
#include <string>

#include "app/session/render_job.h"
#include "engine/core/error.h"

namespace weft {

/// What `--threads`, `--isa` and `--backend` ask of the tools that grow planes: sets the first two
/// for the process, opens the third and says on stderr what was passed over. kNoBackend: this
/// machine has not got it.
[[nodiscard]] Expected<BackendChoice> choose_engine(int threads, const std::string& isa,
                                                    const std::string& backend);

}  // namespace weft

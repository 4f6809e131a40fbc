#pragma once
// Trains the descriptor on the samples' materials.

#include "engine/core/cancel.h"
#include "engine/core/error.h"
#include "engine/core/progress.h"

namespace weft {

class Database;

/// TextureLibrary::train_descriptor(). The caller holds the library's lock.
[[nodiscard]] Status train_descriptor(Database& database, const CancelToken& cancel,
                                      const ProgressFn& progress);

}  // namespace weft

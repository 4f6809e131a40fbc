#pragma once
#include <memory>
#include <string>

#include "app/session/shot.h"
#include "engine/pipeline/stage_store.h"

namespace weft {

/// Keeps planes and motion below `root` (planes/HASH, motion/HASH/FRAME-FRAME); the motion's hash
/// is of the plate's files, its space and the quality. Errors: those of the plate's files.
[[nodiscard]] Expected<std::shared_ptr<StageStore>> open_stage_cache(const Shot& shot,
                                                                     const std::string& root);

}  // namespace weft

#pragma once
#include <memory>
#include <string>

#include "app/shot/shot.h"
#include "engine/core/hash.h"
#include "engine/pipeline/stage_store.h"

namespace weft {

/// Keeps planes and motion below `root` (planes/HASH, motion/HASH/FRAME-FRAME); the motion's hash
/// is of the plate's files, its space and the quality.
[[nodiscard]] std::shared_ptr<StageStore> open_stage_cache(const Shot& shot,
                                                           const std::string& root);

/// Adds all frames of a plate with their stamps. A file that is not there has a stamp of its own:
/// whoever needs it finds out.
void add_plate_stamps(Hasher& hasher, const FrameReader& plate);

}  // namespace weft

#pragma once
#include <memory>
#include <string>

#include "app/shot/shot.h"
#include "engine/core/hash.h"
#include "engine/pipeline/stage_store.h"

namespace weft {

/// Caches planes and motion below `root` (planes/HASH, motion/HASH/FRAME-FRAME). The hash of motion
/// covers the plate's files, its colour space and the quality.
[[nodiscard]] std::shared_ptr<StageStore> open_stage_cache(const Shot& shot,
                                                           const std::string& root);

/// Adds all frames of a plate with their stamps. A missing file has a stamp of its own; the code
/// that reads it reports the error.
void add_plate_stamps(Hasher& hasher, const FrameReader& plate);

}  // namespace weft

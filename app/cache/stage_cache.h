#pragma once
#include <memory>
#include <string>

#include "app/shot/shot.h"
#include "engine/core/hash.h"
#include "engine/pipeline/stage_store.h"

namespace weft {

/// Caches planes and motion below `root` (planes/HASH, motion/HASH/FRAME-FRAME). The hash of motion
/// covers what add_plate_ids() adds, the plate's colour space and the quality.
[[nodiscard]] std::shared_ptr<StageStore> open_stage_cache(const Shot& shot,
                                                           const std::string& root);

/// Adds the id of each frame's file of the shot's plate (Fingerprints::id()). A file that cannot be
/// read has a value of its own; the code that needs it reports the error. Also color_contents().
void add_plate_ids(Hasher& hasher, const Shot& shot);

}  // namespace weft

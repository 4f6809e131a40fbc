#pragma once
// Mattes that were painted a moment ago and may not be on the disk yet.

#include <map>
#include <memory>
#include <string>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/media/image_files.h"

namespace weft {

/// By the absolute path that they are written to. What is there is never changed.
using PaintedMattes = std::map<std::string, std::shared_ptr<const Matte>>;

/// read_matte(), from memory where the matte is there: the same bytes as from its file.
[[nodiscard]] Expected<Matte> read_matte(const std::string& path, const MatteSelect& select,
                                         Size expected, const PaintedMattes& painted);

}  // namespace weft

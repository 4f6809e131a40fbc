#pragma once
// Painted mattes that may not be on disk yet.

#include <map>
#include <memory>
#include <string>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/media/image_files.h"

namespace weft {

/// By the absolute path of their file. The mattes never change.
using PaintedMattes = std::map<std::string, std::shared_ptr<const Matte>>;

/// As read_matte(), but from memory if the matte is in `painted`; the result is the same.
[[nodiscard]] Expected<Matte> read_matte(const std::string& path, const MatteSelect& select,
                                         Size expected, const PaintedMattes& painted);

}  // namespace weft

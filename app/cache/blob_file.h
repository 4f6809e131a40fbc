#pragma once
// Cache files: a header with a checksum, then the bytes compressed by zlib.

#include <optional>
#include <string>

#include "engine/pipeline/analysis_store.h"

namespace weft {

/// Writes atomically, without a flush. Errors: those of the disk.
[[nodiscard]] Status write_blob(const std::string& path, const Bytes& bytes);
/// Returns nothing if the file is missing, damaged or truncated.
[[nodiscard]] std::optional<Bytes> read_blob(const std::string& path);

}  // namespace weft

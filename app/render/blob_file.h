#pragma once
// Files of the cache: a header with a checksum, then the bytes packed by zlib.

#include <optional>
#include <string>

#include "engine/pipeline/analysis_store.h"

namespace weft {

/// Whole or not at all, without a flush. Errors: those of the disk.
[[nodiscard]] Status write_blob(const std::string& path, const Bytes& bytes);
/// Nothing when there is none, or it is damaged or cut off.
[[nodiscard]] std::optional<Bytes> read_blob(const std::string& path);

}  // namespace weft

#pragma once
// Internal: answers of the texture library as JSON.

#include <string>

#include "texture_db/build.h"
#include "texture_db/evaluate.h"
#include "texture_db/import.h"
#include "texture_db/library.h"

namespace weft {

[[nodiscard]] std::string to_json(const SearchResult& result);
[[nodiscard]] std::string to_json(const std::vector<SearchHit>& hits);
[[nodiscard]] std::string to_json(const TextureInfo& info);
[[nodiscard]] std::string to_json(const LibraryStats& stats, const std::string& path);
[[nodiscard]] std::string to_json(const Recommendation& recommendation);
[[nodiscard]] std::string to_json(const ImportReport& report);
[[nodiscard]] std::string to_json(const BuildReport& report, const LibraryStats& stats);
[[nodiscard]] std::string to_json(const BuildEstimate& estimate);
[[nodiscard]] std::string to_json(const std::vector<LibraryFault>& faults);
[[nodiscard]] std::string to_json(const EvaluationReport& report);
/// The credits of exported samples: one object a file.
[[nodiscard]] std::string credits_json(
    const std::vector<std::pair<std::string, TextureInfo>>& files);

}  // namespace weft

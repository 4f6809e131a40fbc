#pragma once
// Internal: answers of the texture library as JSON.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "bench/retrieval/evaluate.h"
#include "texture_db/library/library.h"
#include "texture_db/sources/build.h"
#include "texture_db/sources/import.h"

namespace weft {

[[nodiscard]] nlohmann::ordered_json to_json(const SearchResult& result);
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<SearchHit>& hits);
[[nodiscard]] nlohmann::ordered_json to_json(const TextureInfo& info);
[[nodiscard]] nlohmann::ordered_json to_json(const LibraryStats& stats, const std::string& path);
[[nodiscard]] nlohmann::ordered_json to_json(const Recommendation& recommendation);
[[nodiscard]] nlohmann::ordered_json to_json(const ImportReport& report);
[[nodiscard]] nlohmann::ordered_json to_json(const BuildReport& report, const LibraryStats& stats);
[[nodiscard]] nlohmann::ordered_json to_json(const BuildEstimate& estimate);
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<LibraryFault>& faults);
[[nodiscard]] nlohmann::ordered_json to_json(const EvaluationReport& report);
/// The credits of exported samples: one object per file.
[[nodiscard]] nlohmann::ordered_json credits_json(
    const std::vector<std::pair<std::string, TextureInfo>>& files);

}  // namespace weft

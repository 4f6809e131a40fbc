#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/render/render_job.h"

namespace weft {

inline constexpr const char* kVersion = WEFT_VERSION;

/// The report of a render as one JSON object (docs/FORMATS.md).
[[nodiscard]] std::string report_json(const JobSpec& spec, const JobResult& result);

/// Every parameter of a project and of its regions, by its key.
[[nodiscard]] nlohmann::ordered_json settings_json(const Project& project);

}  // namespace weft

#pragma once
#include <string>

#include "app/session/render_job.h"

namespace weft {

inline constexpr const char* kVersion = WEFT_VERSION;

/// The report of a render as one JSON object (docs/FORMATS.md).
[[nodiscard]] std::string report_json(const JobSpec& spec, const JobResult& result);

}  // namespace weft

#pragma once
// Where the light and the paint of a region could not be told apart, in the words of the command
// line, the report and the editor.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/shot/shot.h"
#include "engine/pipeline/analysis_store.h"

namespace weft {

struct LightReport {
    std::string region;
    double unsure = 0;  ///< Share of the surface, mean of the frames, 0–1.
    double worst = 0;   ///< On the worst frame,
    int worst_frame = 0;
};

/// Of the plan's regions whose light is estimated, from the frames of `frames` that are stored; a
/// region without any has no entry. Errors: those of the store.
[[nodiscard]] Expected<std::vector<LightReport>> light_reports(const Shot& shot,
                                                               const AnalysisStore& store,
                                                               const std::vector<int>& frames);

/// What to say and to do about it: beside the region's settings, and as a warning of a job; nothing
/// where it is little.
[[nodiscard]] std::optional<std::string> unsure_light_text(const LightReport& light);
[[nodiscard]] std::optional<std::string> unsure_light_warning(const LightReport& light);

/// An entry of `lights` in the report (docs/FORMATS.md). Thread-safe.
[[nodiscard]] nlohmann::ordered_json light_json(const LightReport& light);

}  // namespace weft

#pragma once
// Measurements as JSON (docs/CLI.md, `weft measure`).

#include <nlohmann/json_fwd.hpp>

#include "app/measure/measure_job.h"

namespace weft {

/// The measurements of one result: the keys of `weft measure --json` except the warnings.
[[nodiscard]] nlohmann::ordered_json measure_json(const MeasuredResult& result);
/// The keys `truth`, `light` and `form`.
[[nodiscard]] nlohmann::ordered_json truth_json(const TruthMeasures& truth);
[[nodiscard]] nlohmann::ordered_json light_json(const LightMeasures& light);
[[nodiscard]] nlohmann::ordered_json form_measures_json(const FormMeasures& form);

}  // namespace weft

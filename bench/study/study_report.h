#pragma once
#include <string>

#include "bench/study/study.h"

namespace weft {

/// The report as one HTML file: SVG and CSS inline, pictures as base64 JPEG, no network access.
[[nodiscard]] std::string study_html(const StudyResult& study);
/// The report's part on light: pictures of it, how true it is, grain and focus.
[[nodiscard]] std::string study_light_html(const StudyResult& study);
/// All figures and settings (docs/CLI.md, `weft study`).
[[nodiscard]] std::string study_json(const StudyResult& study);
/// One row per method and frame; unknown values are empty.
[[nodiscard]] std::string study_csv(const StudyResult& study);

}  // namespace weft

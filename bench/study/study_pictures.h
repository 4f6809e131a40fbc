#pragma once
#include "bench/study/study.h"

namespace weft {

/// Fills the strip of key frames (the 1st, 10th, 20th and 40th that there are, and the last) and
/// every method's worst step. Errors: of reading; cancellation.
[[nodiscard]] Status add_study_pictures(StudyResult& study, const CancelToken& cancel);

/// "data:image/jpeg;base64,…"
[[nodiscard]] std::string data_uri(const std::vector<std::uint8_t>& jpeg);

}  // namespace weft

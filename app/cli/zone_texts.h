#pragma once
#include <string>
#include <vector>

#include "app/project/project.h"

namespace weft {

/// The zones that --zone gives: each text is KIND=VALUE@MATTE, MATTE as add_matte_text() takes it.
/// What is painted on several frames with the same kind and value is one zone. `crypto_files`: the
/// EXR files of Cryptomattes; empty: the plate. Errors: Usage.
[[nodiscard]] Expected<std::vector<Zone>> parse_zones(const std::vector<std::string>& texts,
                                                      const std::string& crypto_files);

}  // namespace weft

#pragma once
#include <string>
#include <vector>

#include "app/project/project.h"
#include "engine/core/error.h"

namespace weft {

/// Chooses the channel of each of the region's matte sequences for which none is set, once for all
/// of the `frames` that have a file, so that no frame is read by another channel than the rest.
/// Returns warnings of mattes that are nowhere empty or nowhere full. Errors: Unreadable for a
/// matte without a channel or value whose files are no coverage (MatteJudge).
[[nodiscard]] Expected<std::vector<std::string>> choose_matte_channels(
    Region& region, const std::vector<int>& frames);

}  // namespace weft

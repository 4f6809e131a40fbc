#pragma once
#include <string>
#include <vector>

#include "app/project/project.h"

namespace weft {

/// What a user should know about the passes that were chosen.
struct PassChoice {
    std::vector<std::string> notes, warnings;
};

/// Chooses the EXR layer of each of the region's passes for which none is set, once for all
/// `frames` and by the first file that is there: that of the render which the plate's layer and the
/// Cryptomatte belong to, if there are several. Errors: Unreadable for a file without such a pass,
/// and for a light pass that is the plate itself.
[[nodiscard]] Expected<PassChoice> choose_pass_layers(Region& region, const Plate& plate,
                                                      const std::vector<int>& frames);

}  // namespace weft

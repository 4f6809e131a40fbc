#pragma once
#include <optional>
#include <string>

#include "app/project/project.h"

namespace weft {

/// A key of everything in the document that the propagated mattes of a layer (matte_layer.h) depend
/// on: equal keys give equal mattes. `absolute`: the document with absolute paths; `region`: one of
/// its regions. `but`: a frame of which the confirmed part does not count. Pure.
[[nodiscard]] std::string propagation_key(const Project& absolute, const Region& region, int layer,
                                          std::optional<int> but = {});

}  // namespace weft

#pragma once
// Channels of renderers' passes, which are data and not colours.

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

/// One channel of an EXR by its full name, row by row; its size goes to `size`. `pass` names it in
/// messages: "motion". Errors: those of reading; Unreadable if it is not half or float.
[[nodiscard]] Expected<std::vector<float>> read_pass_channel(const std::string& path,
                                                             const std::string& channel,
                                                             std::string_view pass, Size& size);

/// "R, G, B": for messages.
[[nodiscard]] std::string list_of(const std::vector<std::string>& names);

/// A remedy for a pass of another size than the plate's.
inline constexpr const char* kRenderAlike = "render it at the plate's size";

}  // namespace weft

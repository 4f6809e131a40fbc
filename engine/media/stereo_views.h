#pragma once
// Which view of a stereo EXR a layer belongs to, by its name.

#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// A layer's name and the view in it: "shot.Depth" and "left" of "shot.Depth.left" (OpenEXR's
/// convention, Blender) and of "left.shot.Depth" (Nuke).
struct ViewName {
    std::string pass;
    std::string view;  ///< Empty if the name has none.
};

/// `views`: those that the file declares. "left" and "right" count in files that declare none.
/// Small and capital letters are alike; `view` is spelt as in the name.
[[nodiscard]] ViewName split_view(std::string_view name, const std::vector<std::string>& views);

/// "shot." of "shot.Vector": which render of a file a pass belongs to.
[[nodiscard]] std::string_view render_of(std::string_view pass);

}  // namespace weft

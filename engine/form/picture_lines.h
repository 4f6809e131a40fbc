#pragma once
// The straight lines of one picture.

#include <cmath>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/core/image.h"

namespace weft {

/// A straight line on the picture, px.
struct PictureLine {
    glm::dvec2 from{0}, to{0};

    [[nodiscard]] double length() const {
        const glm::dvec2 d = to - from;
        return std::sqrt(d.x * d.x + d.y * d.y);
    }
};

/// The straight edges of a picture by OpenCV's line segment detector (von Gioi et al. 2010), pieces
/// on one line joined, those of 2.2 % of the long side and more, longest first. `luma`:
/// display-encoded, of any size; it is read at 1280 px at most, and the lines are in pixels of what
/// was given. Ends are rounded to 1/16 px. Thread-safe.
[[nodiscard]] std::vector<PictureLine> picture_lines(ViewU8x1 luma);

/// Those that lie on a surface or along its outline: nine tenths of them inside of the matte, grown
/// by 0.5 % of the long side. Thread-safe.
[[nodiscard]] std::vector<PictureLine> lines_on(const std::vector<PictureLine>& lines,
                                                ViewU8x1 matte);

/// The longest of the lines that run in about one direction (15°) in one square of the picture
/// (1/16 of the long side), so that no pattern of many short ones outvotes the rest of the scene.
/// `lines`: longest first; so is the result. Thread-safe.
[[nodiscard]] std::vector<PictureLine> thinned(const std::vector<PictureLine>& lines, Size picture);

}  // namespace weft

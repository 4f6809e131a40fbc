#pragma once
// Where frames lie on the screen: one scale for the ruler, the rows of keys and the curves.

#include <algorithm>
#include <cmath>

#include "ui/base/ctx.h"

namespace weft::ui {

struct FrameScale {
    float x0 = 0, x1 = 1;  ///< Screen places of the first and last visible frame.
    double first = 0, last = 1;
    [[nodiscard]] float x_of(double frame) const {
        return x0 + static_cast<float>((frame - first) / std::max(1e-6, last - first)) * (x1 - x0);
    }
    [[nodiscard]] double at(float x) const {
        return first + static_cast<double>((x - x0) / std::max(1.0f, x1 - x0)) * (last - first);
    }
    [[nodiscard]] float frame_width() const {
        return (x1 - x0) / static_cast<float>(std::max(1e-6, last - first));
    }
};

/// Width of the column with the rows' names; 0 while the keys are not shown.
[[nodiscard]] float key_names_width(const Ctx& c);
/// The scale of a field between two edges of the screen, which shows the frames that the keys area
/// is zoomed to, else the whole shot. The plate has frames.
[[nodiscard]] FrameScale frame_scale(const Ctx& c, float left, float right);

}  // namespace weft::ui

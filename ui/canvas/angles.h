#pragma once
#include <numbers>

namespace weft::ui {

/// In radians.
inline constexpr double kDegree = std::numbers::pi / 180;

}  // namespace weft::ui

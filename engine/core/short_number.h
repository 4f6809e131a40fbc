#pragma once
#include <string>

namespace weft {

/// A number as text with at most `decimals` of them and no zeros at the end; never "-0", which one
/// machine's rounding gives and another's does not. `decimals` ≥ 1. Pure.
[[nodiscard]] std::string short_number(double value, int decimals = 4);

}  // namespace weft

#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace weft::ui {

/// The text in lines no wider than `width` as `measure` has it, broken at spaces only: never inside
/// of a number, between a number and its unit ("16 px", "97 %"), or after "±". A word wider than
/// that has a line of its own. Line ends of the text stay.
[[nodiscard]] std::string wrapped_at_words(std::string_view text, float width,
                                           const std::function<float(std::string_view)>& measure);

}  // namespace weft::ui

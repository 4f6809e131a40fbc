#pragma once
// Small helpers for texts: settings, names of files, messages.

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/geometry.h"

namespace weft {

/// Without blanks, tabs and line breaks at either end.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// The parts between separators, each trimmed. An empty text has one empty part.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

/// 'text', for messages.
[[nodiscard]] std::string quoted(std::string_view text);

/// The text with the middle of every word of more than 1000 bytes left out, for messages.
[[nodiscard]] std::string shortened_words(std::string_view text);

/// "1920x1080", for messages.
[[nodiscard]] std::string size_text(Size size);

/// A to Z as a to z; other bytes stay.
[[nodiscard]] std::string lower_case(std::string_view text);
/// Are both the same but for A to Z and a to z?
[[nodiscard]] bool same_ignoring_case(std::string_view a, std::string_view b);

/// The text as XML has it, in elements and in quotes; without the control characters that XML does
/// not allow.
[[nodiscard]] std::string xml_text(std::string_view text);

/// The shortest decimal text that reads back as the same number.
[[nodiscard]] std::string shortest_text(double number);

}  // namespace weft

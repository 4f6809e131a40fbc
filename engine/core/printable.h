#pragma once
// Makes text from outside safe to print on a terminal.

#include <string>
#include <string_view>

namespace weft {

/// Whether line breaks and tabs stay as they are.
enum class LineBreaks { kKeep, kEscape };

/// The text with all characters escaped that could mislead a terminal or a reader: C0 and C1
/// controls (escape sequences begin with one), DEL, line and paragraph separators and controls of
/// writing direction become \uXXXX, which JSON reads as the same characters. Bytes that are not
/// UTF-8 become U+FFFD. Other text is unchanged.
[[nodiscard]] std::string printable(std::string_view text, LineBreaks breaks = LineBreaks::kEscape);

}  // namespace weft

#pragma once
// Text that came from outside, made fit for a terminal.

#include <string>
#include <string_view>

namespace weft {

/// Whether line breaks and tabs stay as they are.
enum class LineBreaks { kKeep, kEscape };

/// The same text with everything escaped that a terminal or a reader's eye could be misled by: C0
/// and C1 controls (escape sequences begin with one), DEL, line and paragraph separators and the
/// controls of writing direction, as \uXXXX, which JSON reads as the same characters; bytes that
/// are not UTF-8 become U+FFFD. Other text comes back unchanged.
[[nodiscard]] std::string printable(std::string_view text, LineBreaks breaks = LineBreaks::kEscape);

}  // namespace weft

#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"

namespace weft {

/// A numbered file name: `####` or `@@@@` (one character a digit, at least that many), `%04d`, `%d`.
/// A name without any of these is a single file (is_single()).
class SequencePattern {
  public:
    /// Errors: Usage when more than one placeholder stands in the name, or one in the folder part.
    [[nodiscard]] static Expected<SequencePattern> parse(std::string_view text);

    [[nodiscard]] bool is_single() const { return !numbered_; }
    [[nodiscard]] const std::string& text() const { return text_; }
    /// Negative numbers are written as -0012: the sign comes before the padding.
    [[nodiscard]] std::string path_for(int frame) const;
    /// The number in a path that this pattern would write, or nothing.
    [[nodiscard]] Expected<std::vector<int>> list_frames() const;  ///< Ascending. Error: Unreadable folder.

  private:
    std::string text_, prefix_, suffix_;  // whole, before and after the number (prefix has the folder)
    int padding_ = 0;
    bool numbered_ = false;
};

}  // namespace weft

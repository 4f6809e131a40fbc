#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"

namespace weft {

/// A numbered file name: `####` or `@@@@` (at least as many digits as characters), `%04d`, `%d`. A
/// name without any of these is a single file (is_single()). A single # or @ is an ordinary
/// character where the name has a longer placeholder, and where a file of that very name exists.
class SequencePattern {
  public:
    /// Errors: Usage if the name has more than one placeholder, or the folder part has one (a
    /// single # or @ is an ordinary character there).
    [[nodiscard]] static Expected<SequencePattern> parse(std::string_view text);
    /// A single file whose name is used literally (logo@2x.png has no frame number).
    [[nodiscard]] static SequencePattern single(std::string_view path);

    [[nodiscard]] bool is_single() const { return !numbered_; }
    [[nodiscard]] const std::string& text() const { return text_; }
    /// Negative numbers are written as -0012 for #### and @@@@, where the sign comes before the
    /// padding, and as -012 for %04d, where it is one of the places, as in C's printf and 3ds Max.
    /// A single file has the same path for every frame.
    [[nodiscard]] std::string path_for(int frame) const;
    /// The frame number in a path that this pattern would write: path_for(*frame_of(p)) == p. Empty
    /// for other paths and for numbers beyond kMaxFrameNumber.
    [[nodiscard]] std::optional<int> frame_of(std::string_view path) const;
    /// The frames whose files are in the folder now, ascending; none for a single file. Errors:
    /// Unreadable folder, or a file in it numbered beyond kMaxFrameNumber; Usage for a frame among
    /// or beside the others whose file is spelled otherwise and would be left out without a word.
    [[nodiscard]] Expected<std::vector<int>> list_frames() const;

  private:
    // The number in the path, however large (at most kBeyond), if there is one.
    [[nodiscard]] std::optional<std::int64_t> number_in(std::string_view path,
                                                        bool sign_counts) const;
    [[nodiscard]] Error other_spelling(const std::string& path, std::int64_t frame) const;

    std::string text_, prefix_,
        suffix_;  // whole, before and after the number (prefix has the folder)
    int padding_ = 0;
    bool numbered_ = false;
    bool printf_ = false;  // written as %d or %04d
};

}  // namespace weft

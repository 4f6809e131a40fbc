#pragma once
// Internal: author and licence of a file in a Debian package, from its copyright file.

#include <string>
#include <string_view>
#include <vector>

namespace weft {

struct FileLicence {
    std::string author, licence;
};

/// Reads the machine-readable format (DEP 5); of free text, the licence that it names and the first
/// holder.
class CopyrightFile {
  public:
    [[nodiscard]] static CopyrightFile parse(std::string_view text);
    /// The last paragraph whose patterns match `path`. A pattern also matches the end of a path,
    /// because packages rearrange folders. "unknown" if nothing matches.
    [[nodiscard]] FileLicence of(std::string_view path) const;

  private:
    struct Paragraph {
        std::vector<std::string> patterns;
        FileLicence licence;
    };
    std::vector<Paragraph> paragraphs_;
};

}  // namespace weft

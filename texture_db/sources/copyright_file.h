#pragma once
// Internal: who made a file of a Debian package and under which licence, out of its copyright file.

#include <string>
#include <string_view>
#include <vector>

namespace weft {

struct FileLicence {
    std::string author, licence;
};

/// The machine-readable format (DEP 5); of free text, the licence that it names and the first
/// holder.
class CopyrightFile {
  public:
    [[nodiscard]] static CopyrightFile parse(std::string_view text);
    /// The last paragraph whose patterns fit `path`. A pattern also fits a file of which it names
    /// the end of the path: packages rearrange folders. "unknown" where nothing fits.
    [[nodiscard]] FileLicence of(std::string_view path) const;

  private:
    struct Paragraph {
        std::vector<std::string> patterns;
        FileLicence licence;
    };
    std::vector<Paragraph> paragraphs_;
};

}  // namespace weft

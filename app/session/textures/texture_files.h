#pragma once
// The files of the document's textures, which other programs may save while it is open.

#include <cstdint>
#include <string>
#include <vector>

#include "app/base/file_watch.h"
#include "app/session/document/document.h"
#include "app/session/document/notices.h"

namespace weft {

/// Belongs to one thread and never blocks it.
class TextureFiles {
  public:
    /// The references must stay.
    TextureFiles(const Document& document, Notices& notices)
        : document_(document), notices_(notices) {}

    /// The document has changed: watches the textures that it has now.
    void follow();
    /// Says what was saved, and returns the files: they must be shown. Call it in every update.
    [[nodiscard]] std::vector<std::string> take();
    /// Increases with every file that was saved, whether or not it was taken.
    [[nodiscard]] std::uint64_t changes() const { return watch_.changes(); }
    /// Increases with every file that was taken: which versions of the files are shown.
    [[nodiscard]] std::uint64_t version() const { return version_; }

  private:
    const Document& document_;
    Notices& notices_;
    FileWatch watch_;
    std::vector<std::string> followed_;
    std::uint64_t version_ = 0;
};

}  // namespace weft

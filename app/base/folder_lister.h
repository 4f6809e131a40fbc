#pragma once
// Lists a folder for the file browser; a numbered sequence is one entry.

#include <future>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/error.h"

namespace weft {

enum class EntryKind : std::uint8_t { kFolder, kSequence, kMovie, kPicture, kProject, kOther };

struct FolderEntry {
    EntryKind kind = EntryKind::kOther;
    std::string name;     ///< "plate.####.exr"
    std::string path;     ///< Path to open: a pattern for a sequence.
    std::string detail;   ///< "1001–1048, 48 frames"
    std::string preview;  ///< Image for the thumbnail; empty: none.
};

/// Errors: Unreadable. Folders first, then by name.
[[nodiscard]] Expected<std::vector<FolderEntry>> list_folder(const std::string& folder);

/// Lists folders in the background. Belongs to one thread.
class FolderLister {
  public:
    /// The entries of a folder; null while they are being read.
    [[nodiscard]] const std::vector<FolderEntry>* entries(const std::string& folder);
    [[nodiscard]] const std::string& error() const { return error_; }
    /// The file that was asked for instead of a folder; empty: none. entries() are those beside it.
    [[nodiscard]] const std::string& file() const { return file_; }
    /// There is no such folder or file; entries() are those whose names begin like it.
    [[nodiscard]] bool completes() const { return completes_; }
    void refresh() { folder_.clear(); }
    [[nodiscard]] bool busy() const { return pending_.valid(); }

  private:
    struct Listed {
        Expected<std::vector<FolderEntry>> entries;
        std::string file;
        bool completes = false;
    };
    /// What there is at a path, or begins like its last name.
    static Listed listed(const std::string& path);
    std::string folder_, error_, file_;
    std::vector<FolderEntry> entries_;
    bool ready_ = false, completes_ = false;
    std::future<Listed> pending_;
};

}  // namespace weft

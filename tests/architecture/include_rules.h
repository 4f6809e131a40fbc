#pragma once
// The rules on includes (docs/ARCHITECTURE.md), as a checker that works on text.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft::architecture {

/// A folder of ours and all that it may include besides itself: folders, or single headers.
struct Floor {
    std::string_view folder;
    std::vector<std::string_view> may_use;
};

/// A library, by the beginnings of its includes, and the only places that may include it.
struct Library {
    std::string_view name;
    std::vector<std::string_view> includes;  ///< "opencv2/"; beginnings of what stands in <…>.
    std::vector<std::string_view> places;    ///< Folders or single files.
    bool in_headers = false;                 ///< Also in headers, not only in sources.
};

/// What `contents`, the text of the file `path` (relative to the root), breaks; one line each.
[[nodiscard]] std::vector<std::string> broken_rules(std::string_view path,
                                                    std::string_view contents,
                                                    std::span<const Floor> floors,
                                                    std::span<const Library> libraries);

/// A way of opening files, and where it may stand.
struct ReadRule {
    std::string_view call;
    std::string_view guard;  ///< Allowed where this stands in the same file; empty: nowhere.
    struct Exception {
        std::string_view file, reason;
    };
    std::vector<Exception> exceptions;
};

/// The lines of `contents` that open a file in another way; comments do not count.
[[nodiscard]] std::vector<std::string> broken_reads(std::string_view path,
                                                    std::string_view contents,
                                                    std::span<const ReadRule> rules);

}  // namespace weft::architecture

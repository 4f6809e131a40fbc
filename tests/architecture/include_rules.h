#pragma once
// Checks the include rules (docs/ARCHITECTURE.md) on text.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft::architecture {

/// A folder and everything it may include besides itself: folders or single headers.
struct Floor {
    std::string_view folder;
    std::vector<std::string_view> may_use;
};

/// A library, given by prefixes of its includes, and the only places that may include it.
struct Library {
    std::string_view name;
    std::vector<std::string_view> includes;  ///< "opencv2/": prefixes of the text in <…>.
    std::vector<std::string_view> places;    ///< Folders or single files.
    bool in_headers = false;                 ///< Allowed in headers too.
};

/// The violations in `contents`, the text of the file `path` (relative to the root), one per line.
[[nodiscard]] std::vector<std::string> broken_rules(std::string_view path,
                                                    std::string_view contents,
                                                    std::span<const Floor> floors,
                                                    std::span<const Library> libraries);

/// A function that opens files, and where it is allowed.
struct ReadRule {
    std::string_view call;
    std::string_view guard;  ///< Allowed if this occurs in the same file; empty: never.
    struct Exception {
        std::string_view file, reason;
    };
    std::vector<Exception> exceptions;
};

/// The lines of `contents` that open files in another way; comments are ignored.
[[nodiscard]] std::vector<std::string> broken_reads(std::string_view path,
                                                    std::string_view contents,
                                                    std::span<const ReadRule> rules);

}  // namespace weft::architecture

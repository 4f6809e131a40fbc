#pragma once
// Checks of a project that need no file access.

#include <string>
#include <vector>

#include "app/project/project.h"

namespace weft {

enum class Severity {
    kWarning,  ///< It can be rendered, but perhaps not as intended.
    kError     ///< It cannot be rendered.
};

struct Issue {
    Severity severity = Severity::kError;
    std::string what;        ///< "No texture is set"
    std::string where;       ///< "regions[0] 'wall': texture"; a place in the document.
    std::string what_to_do;  ///< "Set a sample (--texture) or a plane (--plane)"

    /// The whole issue in one line.
    [[nodiscard]] std::string text() const;
};

/// Issues in the order of the document; empty if there are none. Pure, thread-safe.
[[nodiscard]] std::vector<Issue> validate(const Project& project);

[[nodiscard]] bool has_errors(const std::vector<Issue>& issues);

}  // namespace weft

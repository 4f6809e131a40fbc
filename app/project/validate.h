#pragma once
// What is wrong with a project as far as the document itself tells: no file is opened.

#include <string>
#include <vector>

#include "app/project/project.h"

namespace weft {

enum class Severity {
    kWarning,  ///< It can be rendered; perhaps not as it was meant.
    kError     ///< It cannot be rendered.
};

struct Issue {
    Severity severity = Severity::kError;
    std::string what;        ///< "No texture is set"
    std::string where;       ///< "regions[0] 'wall': texture"; a place in the document.
    std::string what_to_do;  ///< "Set a sample (--texture) or a plane (--plane)"

    /// All of it in one line.
    [[nodiscard]] std::string text() const;
};

/// In the order of the document; empty when all is well. Pure, thread-safe.
[[nodiscard]] std::vector<Issue> validate(const Project& project);

[[nodiscard]] bool has_errors(const std::vector<Issue>& issues);

}  // namespace weft

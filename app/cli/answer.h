#pragma once
// The result of a command. Every command ends in conclude(), so --json, the exit code and the
// format of errors are the same for all of them (docs/CLI.md, "JSON").

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "engine/core/error.h"

namespace weft {

struct Answer {
    /// The object that --json prints, without "exit_code". Paths are absolute.
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    std::string text = {};  ///< Text printed without --json, line breaks included; may be empty.
    int exit = 0;           ///< 8 when a comparison found a difference; errors have their own code.
    /// Error of a last step: printed after the answer.
    std::optional<Error> error = {};
};
/// An error if there is no answer at all.
using CommandResult = Expected<Answer>;

/// Prints the answer or the error in the requested form (json_output()) and returns the process's
/// exit code.
[[nodiscard]] int conclude(const CommandResult& result);

/// {"schema": "weft.error/1", "error": {"code", "name", "message", "field"?, "remedy"?}}. The field
/// is the option ("--threads") or the place in the document ("regions[0].placement.scale") that the
/// error names.
[[nodiscard]] nlohmann::ordered_json error_json(const Error& error);

/// The absolute path; an empty one and a texture "db:ID" are unchanged. Patterns keep their
/// placeholders.
[[nodiscard]] std::string absolute_path(const std::string& path);

}  // namespace weft

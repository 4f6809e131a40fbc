#pragma once
// What a command hands back. Every command ends through conclude(), so that --json, the exit code
// and the form of an error are the same for all of them (docs/CLI.md, "JSON").

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "engine/core/error.h"

namespace weft {

struct Answer {
    /// The object that --json prints, without "exit_code". Paths are absolute.
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    std::string text = {};  ///< What is printed without --json, line breaks included; may be empty.
    int exit = 0;  ///< 8 where a comparison found a difference; errors have their own code.
    /// What failed after the rest was done: the answer is printed, then this.
    std::optional<Error> error = {};
};
/// An error when there is nothing else to tell.
using CommandResult = Expected<Answer>;

/// Prints the answer, or the error, in the form that was asked for (json_output()), and returns the
/// process's exit code.
[[nodiscard]] int conclude(const CommandResult& result);

/// {"schema": "weft.error/1", "error": {"code", "name", "message", "field"?, "remedy"?}}. The field
/// is the option ("--threads") or the place in the document ("regions[0].placement.scale") that the
/// error names, the remedy its last sentence.
[[nodiscard]] nlohmann::ordered_json error_json(const Error& error);

/// The path as seen from anywhere; an empty one and a texture "db:ID" stay as they are. Patterns
/// keep their placeholders.
[[nodiscard]] std::string absolute_path(const std::string& path);

}  // namespace weft

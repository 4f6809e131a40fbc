#pragma once
// Protects the input files of a project from being overwritten by a run.

#include <memory>
#include <string>
#include <vector>

#include "app/project/project.h"
#include "engine/core/error.h"
#include "engine/media/write_rule.h"

namespace weft {

/// Restricts where a command may write, and lists what it reads besides the project's inputs.
struct WriteLimits {
    std::string root;  ///< Folder that all writes must stay in; empty: no restriction.
    std::vector<std::string> reads;  ///< Files, folders and patterns: the project file, a look, …
    /// Further allowed folders, in addition to `root`.
    std::vector<std::string> roots = {};
};

/// Builds a fence around every input of `project` (absolute paths): plate, mattes and holdouts
/// (also painted and frozen ones, Cryptomattes and their manifests), textures and their credits,
/// planes, passes and tracks, and `limits.reads`. Errors: Usage when the root is a file.
[[nodiscard]] Expected<std::shared_ptr<const WriteFence>> make_fence(const Project& project,
                                                                     const WriteLimits& limits);

/// A file that a run will write, with its description ("The movie", "Frame 12").
struct PlannedFile {
    std::string what, path;
};
/// Errors: Usage when two of them are the same file; the message names both.
[[nodiscard]] Status check_apart(const std::vector<PlannedFile>& files);

}  // namespace weft

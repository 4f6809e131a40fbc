#pragma once
// The files that a project is made from, and the fence that keeps a run from writing over them.

#include <memory>
#include <string>
#include <vector>

#include "app/project/project.h"
#include "engine/core/error.h"
#include "engine/media/write_rule.h"

namespace weft {

/// Where a command may write, and what it reads besides the project's own inputs.
struct WriteLimits {
    std::string root;                ///< Nothing is written outside of it; empty: anywhere.
    std::vector<std::string> reads;  ///< Files, folders, patterns: the project file, a look, …
    /// Further roots: what lies in one of them or in `root` may be written.
    std::vector<std::string> roots = {};
};

/// A fence around every input of `project`, which has absolute paths: plate, mattes and holdouts
/// (painted and frozen ones and Cryptomattes with their manifests too), textures with their
/// credits, planes, passes and tracks; and around `limits.reads`. Errors: Usage when the root is a
/// file.
[[nodiscard]] Expected<std::shared_ptr<const WriteFence>> make_fence(const Project& project,
                                                                     const WriteLimits& limits);

/// A file that a run is about to write, and what it is in words ("The movie", "Frame 12").
struct PlannedFile {
    std::string what, path;
};
/// Errors: Usage when two of them are one file, naming both.
[[nodiscard]] Status check_apart(const std::vector<PlannedFile>& files);

}  // namespace weft

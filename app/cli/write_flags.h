#pragma once
// --overwrite and --output-root, on every command that writes files.

#include <string>
#include <vector>

#include "app/exchange/input_files.h"
#include "engine/media/write_rule.h"

namespace CLI {
class App;
}

namespace weft {

struct WriteFlags {
    bool overwrite = false;
    std::string root;  ///< Of --output-root; empty: none.
};

/// Adds both flags.
void add_write_flags(CLI::App& command, WriteFlags& flags);
/// Only --output-root, for a command that has its own --overwrite.
void add_output_root_flag(CLI::App& command, std::string& root);

/// The rule for a command's outputs, which may not be written over `reads` (files, folders,
/// patterns) or over an input of `project`, whose paths are absolute. Errors: as make_fence().
[[nodiscard]] Expected<WriteRule> write_rule(const WriteFlags& flags,
                                             const std::vector<std::string>& reads,
                                             const Project& project = {});

}  // namespace weft

#pragma once
// --overwrite and --output-root, for every command that writes files.

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
    std::string root;  ///< Value of --output-root; empty: none.
};

/// Adds both flags.
void add_write_flags(CLI::App& command, WriteFlags& flags);
/// Adds --output-root only, for a command that has its own --overwrite.
void add_output_root_flag(CLI::App& command, std::string& root);

/// The write rule for a command's outputs. They must not overwrite `reads` (files, folders,
/// patterns) or an input of `project`, whose paths are absolute. Errors: as make_fence().
[[nodiscard]] Expected<WriteRule> write_rule(const WriteFlags& flags,
                                             const std::vector<std::string>& reads,
                                             const Project& project = {});

}  // namespace weft
